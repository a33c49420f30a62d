// The page without a server: it hands what it asks to a worker that runs the program (worker.js). Files are in the worker's
// memory and in the browser's own store; here they are opened and shown.
{
  const text = (id) => document.getElementById(id)?.textContent;
  const [program, script, thread] = [text("phyllite-program"), text("phyllite-worker"), text("phyllite-thread")];
  const worker = new Worker(URL.createObjectURL(new Blob([program, script], { type: "text/javascript" })));
  const waiting = new Map(); // by number: who waits for an answer
  let number = 0;
  let open;
  const ready = new Promise((resolve) => (open = resolve));

  async function ask(what, data = {}, transfer = []) {
    await ready;
    return new Promise((resolve) => {
      waiting.set(++number, resolve);
      worker.postMessage({ ask: what, id: number, ...data }, transfer);
    });
  }

  worker.onmessage = ({ data }) => {
    if (data.ready) open(data);
    else if (data.taken) say("This page is open in another tab, which has its files. Go on there, or close it and load this one anew.");
    else if (data.trouble) say(data.trouble);
    else {
      waiting.get(data.id)(data.found);
      waiting.delete(data.id);
    }
  };
  worker.onerror = (e) => say(`The program has failed: ${e.message}. Load this page anew.`);

  /** For web/src/gui/server.ts. */
  globalThis.phyllite = {
    async answer(method, target, body) {
      const url = new URL(target, "http://x");
      const bytes = body === undefined ? new Uint8Array() : new Uint8Array(await new Blob([body]).arrayBuffer());
      return ask("answer", { method, path: decodeURIComponent(url.pathname), query: Object.fromEntries(url.searchParams), body: bytes }, [bytes.buffer]);
    },
  };

  // --- files ---------------------------------------------------------------------------------------------------

  function download(name, bytes, type) {
    const address = URL.createObjectURL(new Blob([bytes], { type }));
    Object.assign(document.createElement("a"), { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 60000);
  }

  const escaped = (html) => html.replaceAll("&", "&amp;").replaceAll('"', "&quot;");

  /** A page of the folder runs its scripts, but not as this one: they cannot reach what is kept. */
  const around = (html, name) => `<!doctype html><meta charset="utf-8"><title>${escaped(name).replaceAll("<", "&lt;")}</title>
<style>html, body, iframe { display: block; width: 100%; height: 100%; margin: 0; border: 0 }</style>
<iframe title="${escaped(name)}" sandbox="allow-scripts allow-downloads allow-modals" srcdoc="${escaped(html)}"></iframe>`;

  async function show(path) {
    const { status, type, body } = await globalThis.phyllite.answer("GET", `/files/${path}`);
    const name = decodeURIComponent(path.split("/").pop());
    if (status !== 200 || !type.startsWith("text/")) return download(name, body, type);
    const page = type.startsWith("text/html");
    const shown = page ? around(new TextDecoder().decode(body), name) : body;
    window.open(URL.createObjectURL(new Blob([shown], { type: page ? type : "text/plain; charset=utf-8" })), "_blank", "noopener");
  }

  document.addEventListener("click", (e) => {
    const link = e.target instanceof Element && e.target.closest('a[href^="#/files/"]');
    if (!link) return;
    e.preventDefault();
    void show(link.getAttribute("href").slice("#/files/".length));
  });

  const plain = (path) => path.split("/").every((part) => part !== "" && !part.startsWith(".") && !part.includes("\\"));

  async function bring(list) {
    const files = [];
    for (const file of list) {
      const path = file.webkitRelativePath.split("/").slice(1).join("/");
      if (plain(path) || path.endsWith("/.lock")) files.push({ path, bytes: new Uint8Array(await file.arrayBuffer()), time: file.lastModified });
    }
    await ask("put", { files }, files.map((f) => f.bytes.buffer));
    location.reload();
  }

  // --- what it says above the rocks ----------------------------------------------------------------------------

  const element = (name, settings, ...children) => {
    const made = Object.assign(document.createElement(name), settings);
    made.append(...children);
    return made;
  };
  const said = element("p", { role: "status" });
  const computing = element("span");
  const say = (line) => (said.textContent = line);
  const chooser = element("input", { type: "file", webkitdirectory: true, hidden: true, ariaLabel: "Folder to open" });
  chooser.addEventListener("change", () => void bring(chooser.files));
  const save = element("button", { type: "button" }, "Download all files");
  save.addEventListener("click", async () => download("phyllite.zip", await ask("zip"), "application/zip"));
  const choose = element("button", { type: "button" }, "Open a folder");
  choose.addEventListener("click", () => chooser.click());
  const tools = element("div", { className: "tools" }, save, choose, chooser);
  document.getElementById("main").before(
    element("section", { ariaLabel: "In this browser" }, element("p", {}, "The program runs in this browser, and nothing leaves it. ", computing), tools, said),
  );
  const several = (n) => `Each command computes on ${n} threads.`;
  const one = "Each command computes on one thread; the installed program uses all cores.";
  void ready.then(({ threads }) => (computing.textContent = threads > 1 ? several(threads) : one));
  void ready.then(({ keeps }) => say(keeps ? "Files are kept in this browser. Download what you want to keep for good." : "This browser keeps no files: download them before you leave."));

  if (thread && !crossOriginIsolated) say("This page computes on several threads. Browsers allow them only where a server sends Cross-Origin-Opener-Policy: same-origin and Cross-Origin-Embedder-Policy: require-corp, by https or on this machine. Open phyllite.html, which has one thread and opens anywhere.");
  else worker.postMessage({ role: "desk", wasm: text("phyllite-wasm"), program, worker: script, thread });
}

// What runs in the workers of the page: the program without a server (page.js). One instance keeps the folder and answers the
// page; every long command is another instance in a worker of its own, with copies of the files, and what it writes comes back.
const folder = "/rocks";
const passing = ".phyllite-"; // in names of files that are being written (src/io/disk.hpp)
let program;

/** `seen` is called with each file of the folder: its path, what is known of it, and what tells a change. */
function walk(seen, path = folder) {
  for (const name of program.FS.readdir(path)) {
    if (name === "." || name === ".." || name.includes(passing)) continue;
    const at = `${path}/${name}`;
    const { node } = program.FS.lookupPath(at);
    if (program.FS.isDir(node.mode)) walk(seen, at);
    else seen(at, node, `${node.id} ${node.usedBytes} ${node.timestamp}`);
  }
}

const bytesOf = (path, node) => ({ path, bytes: program.FS.readFile(path), time: node.timestamp });

const aboveOf = (path) => path.slice(0, path.lastIndexOf("/"));

function put({ path, bytes, time }) {
  program.FS.mkdirTree(aboveOf(path));
  program.FS.writeFile(path, bytes);
  program.FS.utime(path, time, time);
}

function remove(path) {
  if (program.FS.analyzePath(path).exists) program.FS.unlink(path);
  const isEmpty = (at) => at !== folder && program.FS.analyzePath(at).exists && program.FS.readdir(at).length === 2;
  for (let above = aboveOf(path); isEmpty(above); above = aboveOf(above)) program.FS.rmdir(above);
}

/** What has changed since the last time: files with their bytes, and paths that are no more. */
function changes(known) {
  const written = [];
  const gone = new Set(known.keys());
  walk((path, node, state) => {
    gone.delete(path);
    if (known.get(path) === state) return;
    known.set(path, state);
    written.push(bytesOf(path, node));
  });
  for (const path of gone) known.delete(path);
  return { written, removed: [...gone] };
}

async function begin(wasm, settings) {
  program = await phyllite({
    noInitialRun: true,
    instantiateWasm: (imports, done) => (WebAssembly.instantiate(wasm, imports).then((instance) => done(instance, wasm)), {}),
    ...settings,
  });
  program.FS.mkdirTree(folder);
  program.FS.chdir(folder);
}

// --- a command -------------------------------------------------------------------------------------------------

const script = (...texts) => new Blob(texts, { type: "text/javascript" });

const withThreads = (parts) => parts && { threads: parts.threads, begins: true, mainScriptUrlOrBlob: script(parts.program), locateFile: () => URL.createObjectURL(script(parts.thread)) };

const soon = 100; // from one look at the files to the next [ms]

/** `parts`: of the program with threads, what each of its workers loads, and how many may compute. */
async function command({ wasm, number, words, files, parts }) {
  const known = new Map();
  let last = 0;
  const share = () => {
    const { written, removed } = changes(known);
    last = performance.now();
    if (written.length + removed.length > 0) postMessage({ written, removed }, written.map((w) => w.bytes.buffer));
  };
  const print = (line) => postMessage({ printed: `${line}\n` });
  let exit;
  const ended = new Promise((resolve) => (exit = resolve));
  await begin(wasm, { number, print, printErr: print, onExit: exit, share: () => performance.now() - last > soon && share(), ...withThreads(parts) });
  files.forEach(put);
  changes(known);
  try {
    program.callMain(words); // with threads it runs on one of them, and files stay here
  } catch (error) {
    if (error?.name !== "ExitStatus") {
      print(String(error));
      exit(4);
    }
  }
  const code = await ended;
  share();
  postMessage({ ended: code });
}

// --- the folder ------------------------------------------------------------------------------------------------

const children = new Map(); // by number: the worker, the descriptor of its log, its exit code when it has one
const byPage = 256; // added to the exit code of what was ended from here (src/system/child_web.cpp)
let last = 1;
let source; // this script, at an address of this worker's own: below file:// another's is closed to it
let module;
let parts; // of the program with threads

function end(number, code) {
  const child = children.get(number);
  if (!child || child.code >= 0) return false;
  child.worker.terminate();
  child.code = code;
  program.FS.close(child.log);
  return true;
}

function start(words, descriptor) {
  const number = ++last;
  const log = program.FS.getStream(descriptor);
  const worker = new Worker(source);
  children.set(number, { worker, log, code: -1 });
  const encoder = new TextEncoder();
  const say = (text) => {
    const bytes = encoder.encode(text);
    program.FS.write(log, bytes, 0, bytes.length);
  };
  worker.onmessage = ({ data }) => {
    if (children.get(number).code >= 0) return;
    if (data.printed) say(data.printed);
    data.removed?.forEach(remove);
    data.written?.forEach(put);
    if (data.ended !== undefined) end(number, data.ended);
    keepSoon();
  };
  worker.onerror = (e) => {
    say(`${e.message}\n`);
    end(number, 4);
  };
  const files = [];
  walk((path, node) => files.push(bytesOf(path, node)));
  worker.postMessage({ role: "command", wasm: module, number, words, files, parts });
  return number;
}

// The browser's own store: what is there after a reload.

const done = (request) => new Promise((good, bad) => ((request.onsuccess = () => good(request.result)), (request.onerror = () => bad(request.error))));
let store = null; // null: this browser keeps nothing
const kept = new Map();
let keeping = Promise.resolve();
let timer = 0;

async function openStore() {
  const request = indexedDB.open("phyllite", 1);
  request.onupgradeneeded = () => request.result.createObjectStore("files", { keyPath: "path" });
  store = await done(request);
  for (const file of await done(store.transaction("files").objectStore("files").getAll())) put(file);
  changes(kept);
}

function keep() {
  clearTimeout(timer);
  timer = 0;
  if (!store) return keeping;
  const { written, removed } = changes(kept);
  if (written.length + removed.length === 0) return keeping;
  const writing = store.transaction("files", "readwrite");
  const files = writing.objectStore("files");
  written.forEach((file) => files.put(file));
  removed.forEach((path) => files.delete(path));
  return (keeping = new Promise((good, bad) => ((writing.oncomplete = good), (writing.onabort = () => bad(writing.error)))));
}

function keepSoon() {
  timer ||= setTimeout(() => keep().catch((error) => postMessage({ trouble: `This browser did not keep the files: ${error}. Download them before you leave.` })), 1000);
}

// --- an archive of all files, as they are: none is compressed ------------------------------------------------

const table = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? (n >>> 1) ^ 0xedb88320 : n >>> 1;
  return n;
});
const checksum = (bytes) => (bytes.reduce((sum, byte) => table[(sum ^ byte) & 255] ^ (sum >>> 8), -1) ^ -1) >>> 0;

function zip(files) {
  const [parts, places] = [[], []];
  let at = 0;
  for (const { path, bytes, time } of files) {
    const name = new TextEncoder().encode(path);
    const day = new Date(time);
    const stamp = (((day.getFullYear() - 1980) << 25) | ((day.getMonth() + 1) << 21) | (day.getDate() << 16) | (day.getHours() << 11) | (day.getMinutes() << 5) | (day.getSeconds() >> 1)) >>> 0;
    const head = new DataView(new ArrayBuffer(26)); // what both of its entries have: version, names in UTF-8, stored
    head.setUint16(0, 20, true);
    head.setUint16(2, 0x800, true);
    head.setUint32(6, stamp, true);
    head.setUint32(10, checksum(bytes), true);
    head.setUint32(14, bytes.length, true);
    head.setUint32(18, bytes.length, true);
    head.setUint16(22, name.length, true);
    const local = new Uint8Array([0x50, 0x4b, 3, 4]);
    parts.push(local, head.buffer, name, bytes);
    const more = new DataView(new ArrayBuffer(14)); // comment, disk, attributes, place
    more.setUint32(10, at, true);
    places.push(new Uint8Array([0x50, 0x4b, 1, 2, 20, 0]), head.buffer, more.buffer, name);
    at += 30 + name.length + bytes.length;
  }
  const length = places.reduce((n, part) => n + part.byteLength, 0);
  const end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, 0x06054b50, true);
  end.setUint16(8, files.length, true);
  end.setUint16(10, files.length, true);
  end.setUint32(12, length, true);
  end.setUint32(16, at, true);
  return new Blob([...parts, ...places, end.buffer]);
}

/** As src/gui/server_web.cpp has it. */
function answer({ method, path, query, body }) {
  const head = JSON.stringify({ method, path, query });
  const n = program.lengthBytesUTF8(head) + 1;
  const at = program._malloc(n + body.length);
  program.stringToUTF8(head, at, n);
  program.HEAPU8.set(body, at + n);
  const given = program._phyllite_answer(at, at + n, body.length);
  program._free(at);
  const [address, length, status, type] = new Uint32Array(program.HEAPU8.buffer, given, 4);
  return { status, type: program.UTF8ToString(type), body: program.HEAPU8.slice(address, address + length) };
}

const reading = ["/api/check", "/api/recipe", "/api/table"];

const asked = {
  async answer(data) {
    const found = answer(data);
    if (data.method !== "GET" && !reading.includes(data.path)) await keep();
    return found;
  },
  async zip() {
    const files = [];
    walk((path, node) => files.push({ ...bytesOf(path, node), path: path.slice(folder.length + 1) }));
    return zip(files);
  },
  async put({ files }) {
    for (const file of files) put({ ...file, path: `${folder}/${file.path}` });
    await keep();
  },
};

const unpacked = (base64) => {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
};

/** One tab at a time has the files. After a reload the page before may still have them for a moment. */
async function isAlone() {
  if (!navigator.locks) return true; // a page from a server without encryption
  const taken = (tell) => (lock) => {
    tell(lock !== null);
    return lock && new Promise(() => {}); // until this worker ends
  };
  for (let i = 0; i < 20; ++i) {
    if (await new Promise((tell) => void navigator.locks.request("phyllite", { ifAvailable: true }, taken(tell)))) return true;
    await new Promise((next) => setTimeout(next, 100));
  }
  return false;
}

/** Of a command, whose threads share 4 GB. One core is left to the page where there are more than two. */
const nThreads = () => Math.min(16, Math.max(2, navigator.hardwareConcurrency - 1));

/** This instance has no threads itself. `thread`: what those of its commands load, if they have any. */
async function desk({ wasm, program: text, worker, thread }) {
  const alone = await isAlone();
  if (!alone) return postMessage({ taken: true });
  module = await WebAssembly.compile(await unpacked(wasm));
  source = URL.createObjectURL(script(text, worker));
  const threads = thread ? nThreads() : 1;
  if (thread) parts = { program: text, thread, threads };
  await begin(module, { number: 1, threads, start, ended: (number) => children.get(number)?.code ?? 0, end: (number) => end(number, byPage + 9) });
  // Without locks nobody knows whether another tab has the files, so this one keeps none.
  if (navigator.locks) await openStore().catch(() => (store = null));
  postMessage({ ready: true, keeps: store !== null, threads });
}

onmessage = ({ data }) => {
  if (data.role === "command") return void command(data);
  if (data.role === "desk") return void desk(data).catch((error) => postMessage({ trouble: `The program does not start in this browser: ${error}. It needs one of 2023 or later.` }));
  asked[data.ask](data).then(
    (found) => postMessage({ id: data.id, found }, found?.body ? [found.body.buffer] : []),
    (error) => postMessage({ id: data.id, found: { status: 500, type: "application/json", body: new TextEncoder().encode(JSON.stringify({ error: String(error) })) } }),
  );
};

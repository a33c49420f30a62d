// The page to work in: lays it out, opens rocks, asks again and again how they are.
import { fold, h, theme } from "../dom";
import { benchView } from "./bench";
import { calibrationView } from "./calibration";
import { goTo, onReturn, placeNow } from "./address";
import { attempt, button, counted, keyed, nameOptions, objections } from "./controls";
import { draft, onDraft } from "./drafts";
import { findingsView } from "./findings";
import { grabView } from "./grab";
import { redrawLive } from "./live";
import { resultsView } from "./results";
import { Rock } from "./rock";
import { rockFileView } from "./rockfile";
import { Checked, Gone, Project, Refused, RockAnswer, ask, askProject, onConnection } from "./server";
import { StartView, startView } from "./start";
import { steps, textSwitch } from "./steps";
import { TableView, tableView } from "./table";
import { quoted, set } from "./toml";

const main = document.getElementById("main")!;
const contents = document.getElementById("contents")!;
const saving = document.getElementById("saving")!;

let project: Project;
let open: { rock: Rock; table: TableView; show: () => void; meet: (answer: RockAnswer) => void; running: boolean } | null = null;
let starting: StartView | undefined; // once the program has answered

function section(id: string, title: string, ...children: Node[]): HTMLElement {
  return h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), ...children);
}

// --- the program answers, or not ------------------------------------------------------------------------------

const away = h("div", { class: "notice", role: "alert" }, h("strong", {}, "The program has been stopped. "), "Start ", h("code", {}, "phyllite gui"), " again in this folder. The table as typed is kept in this browser.");
const stranger = h("div", { class: "notice", role: "alert" }, h("strong", {}, "The program does not know this page any more. "), "Open the address that it has printed. The table as typed is kept in this browser.");
const trouble = h("div", { class: "notice", role: "alert" });
for (const n of [away, stranger, trouble]) n.hidden = true;
document.getElementById("bar")!.prepend(away, stranger, trouble);

onConnection((answers) => {
  if (answers && !away.hidden) recheck();
  away.hidden = answers;
});

// --- rocks ----------------------------------------------------------------------------------------------------

const opening = objections();
const rockList = h("ul", { class: "rocks" });
const folder = h("p", { class: "muted" });
const place = h("div");
const first = h("div");

const another = fold("Another rock");
const rockAddress = (name: string, calibration = "") => `/api/rock?name=${encodeURIComponent(name)}&calibration=${encodeURIComponent(calibration)}`;

function listRocks() {
  const states = project.rocks.map((r) => [r.name, r.verdict ?? r.state, draft(project.folder, r.name) !== null, r.name === open?.rock.name]);
  keyed(rockList, states, () =>
    project.rocks.map((r) => {
      const b = button(r.name, () => void attempt(opening, () => visit(r.name)));
      b.append(h("small", {}, r.verdict ?? r.state, draft(project.folder, r.name) ? ", not saved" : ""));
      if (r.name === open?.rock.name) b.setAttribute("aria-current", "true");
      return h("li", {}, b);
    }),
  );
}

/** A rock that has just been written. */
async function created(name: string) {
  project = await askProject();
  await visit(name);
}

// --- the rock that is open ------------------------------------------------------------------------------------

let recheck = () => {};

function layOut(answer: RockAnswer) {
  const rock = new Rock(project.folder, answer, () => show());
  const name = rock.name;
  const table = tableView(project, (t, step) => rock.edit({ table: t }, step), () => rock.undo(), () => rock.redo());
  const rockFile = rockFileView(project, (t, step) => rock.edit({ toml: t }, step));
  const grab = grabView(name, { turned: () => findings.redraw(), changed: refresh });
  const findings = findingsView(name, grab.node, grab.marked);
  const grains = (size: string | null) => rock.edit({ toml: set(rock.text.toml, "", "grain_size", size === null ? null : quoted(size)) }, "grain size");
  const calibration = calibrationView(name, project, { ready, changed: refresh, choose: (folder) => void attempt(opening, () => visit(name, folder)), grains });
  const bench = benchView(name, project, refresh);
  const results = resultsView(name);
  const conflict = h("div");
  const wrong = objections();
  const way = steps();
  contents.replaceChildren(contents.firstElementChild!, ...way.items);
  let checked: Checked | null = null;
  let asked = 0;
  let fresh = -1; // which was answered last
  let last = "";
  let timer = 0;

  place.replaceChildren(
    conflict,
    h("div", { class: "two" }, section("table", "Table", table.node), section("check", "What the table says", findings.node), section("rock-file", "Rock file", rockFile.node)),
    section("calibration", "Calibration", calibration.node),
    section("tests", "Tests on the calibrated rock", bench.node),
    section("results", "Results", results.node),
  );

  const state = h("p", { role: "status" });
  const save = button("Save", () => void attempt(wrong, () => rock.save()), { class: "main", "aria-keyshortcuts": "Control+S" });
  const discard = button("Discard changes", () => rock.discard());
  const back = button("Undo", () => rock.undo(), { "aria-keyshortcuts": "Control+Z" });
  const forth = button("Redo", () => rock.redo(), { "aria-keyshortcuts": "Control+Y" });
  saving.replaceChildren(state, save, back, forth, discard, wrong);

  function show() {
    table.show(rock.text.table, answer.table_file);
    rockFile.show(rock.text.toml, `${name}.toml`);
    keyed(state, rock.dirty, () => [h("span", { class: rock.dirty ? "unsaved" : "muted" }, rock.dirty ? `${name}: not saved` : `${name}: saved`)]);
    save.disabled = !rock.dirty;
    back.disabled = !rock.canUndo;
    forth.disabled = !rock.canRedo;
    discard.hidden = !rock.dirty || rock.gone;
    save.title = `writes ${name}.toml${rock.text.table === null ? "" : `, ${answer.table_file}`}`;
    calibration.show(answer, rock);
    walked();
    keyed(conflict, [rock.theirs, rock.gone], () => (rock.gone ? [gone()] : rock.theirs ? [choose()] : []));
    schedule();
    listRocks();
  }

  const gone = () => h("p", { class: "notice", role: "alert" }, "The files of this rock are gone; Save writes them again.");

  /** Somebody else has changed the files. */
  function choose(): HTMLElement {
    const theirs = rock.theirs!;
    return h(
      "section",
      { class: "notice", "aria-label": "The files have been changed" },
      h("h2", {}, "The files have been changed elsewhere"),
      h("p", {}, `${answer.table_file} or ${name}.toml is another than the one that this page began with. Below is the file as it is now; what is typed here stands further down.`),
      h("div", { class: "theirs" }, h("div", {}, h("h3", {}, answer.table_file), h("pre", { tabindex: "0" }, theirs.table ?? "is edited in its own program")), h("div", {}, h("h3", {}, `${name}.toml`), h("pre", { tabindex: "0" }, theirs.toml))),
      h("div", { class: "tools" }, button("Keep mine", () => void attempt(wrong, () => rock.keepMine())), button("Take the file’s", () => rock.discard())),
    );
  }

  /** How far the rock has come. */
  function walked() {
    const problems = checked?.problems ?? [];
    const state = rock.gone ? "its files are gone" : rock.dirty ? "not saved" : "saved";
    way.show("table", problems.length > 0 || rock.gone ? "wrong" : rock.dirty ? "waiting" : "done", state);
    if (fresh === asked) way.show("check", problems.length > 0 ? "wrong" : "done", problems.length > 0 ? `${problems.length} to mend` : "in order");
    else way.show("check", "running", "checking");
    const c = answer.calibration, tests = answer.tests;
    const done = c.verdict?.status ?? (c.state === "new" ? "to be started" : c.state);
    way.show("calibration", c.state === "running" ? "running" : c.state === "failed" ? "wrong" : c.state === "finished" ? "done" : "waiting", c.state === "running" ? "running" : done);
    const over = tests.filter((t) => t.state === "finished").length;
    const ready = answer.calibrations.some((b) => b.tested);
    way.show("tests", tests.some((t) => t.state === "running") ? "running" : over > 0 ? "done" : "waiting", tests.some((t) => t.state === "running") ? "running" : over > 0 ? `${counted(over, "test")} made` : ready ? "ready" : "waits for a calibration");
    way.show("results", c.verdict || over > 0 ? "done" : "waiting", c.verdict || over > 0 ? "to be seen" : "none yet");
  }

  function schedule() {
    const now = JSON.stringify([rock.text, rock.text.table === null && answer.stamp]); // a workbook changes under the page
    if (now === last) return;
    last = now;
    ++asked; // an answer to what stood here before is not of what stands here now
    clearTimeout(timer);
    timer = window.setTimeout(check, 400);
    findings.busy("Checking …");
    walked();
  }

  /** Whether the answer is of the text as it stands now. */
  async function check(): Promise<boolean> {
    const mine = ++asked;
    try {
      const answered = await ask<Checked>("/api/check", { name, ...rock.text });
      if (mine !== asked) return false;
      checked = answered;
      fresh = mine;
      calibration.mark(checked);
      grab.mark(checked, rock.text);
      walked();
      table.mark(checked);
      rockFile.mark(checked);
      const n = checked.problems.length;
      findings.show(checked, n === 0 ? "No problems in the table and the rock file." : `${counted(n, "problem")} to mend${rock.text.table === null ? "" : ", said beside the cells and lines"}.`);
    } catch (error) {
      if (mine === asked) findings.busy(`Not checked: ${(error as Error).message}.`);
    }
    return mine === asked;
  }

  recheck = () => {
    last = "";
    schedule();
  };

  /** Calibrations read the files. */
  async function ready() {
    clearTimeout(timer);
    if (!(await check())) throw new Error("the table or the rock file has just been changed; press the button again");
    if (checked && checked.problems.length > 0) throw new Error("the table or the rock file has problems, said above; mend them first");
    if (rock.dirty && !(await rock.save())) throw new Error("the files have been changed elsewhere: choose above which to keep");
  }

  function meet(next: RockAnswer) {
    answer = next;
    rock.meet(next);
    calibration.show(next, rock);
    bench.show(next);
    results.show(next);
    grab.show(next, rock.text);
    walked();
    if (open) open.running = [next.calibration, ...next.calibrations].some((c) => c.state === "running") || next.tests.some((t) => t.state === "running");
  }

  open = { rock, table, show, meet, running: false };
  document.getElementById("title")!.textContent = name;
  document.title = `${name} – Phyllite`;
  show();
  rock.takeDraft();
  meet(answer);
}

/** Shows what the address names. */
async function arrive() {
  const { rock, calibration } = placeNow();
  if (rock === "") return leave();
  const answer = await ask<RockAnswer>(rockAddress(rock, calibration));
  if (open?.rock.name === rock) return open.meet(answer);
  layOut(answer);
  another.open = false;
  arrange();
  document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView();
}

/** No rock is open. */
function leave() {
  if (!open) return;
  open = null;
  contents.replaceChildren(contents.firstElementChild!);
  place.replaceChildren();
  saving.replaceChildren();
  document.getElementById("title")!.textContent = document.title = "Phyllite";
  arrange();
  listRocks();
}

/** The ways to begin stand open as long as no rock does. */
function arrange() {
  another.hidden = open === null;
  (open ? another : first).append(starting!.node);
}

async function visit(rock: string, calibration = "") {
  goTo({ rock, calibration });
  await arrive();
}

// --- time passes ----------------------------------------------------------------------------------------------

let turn = 0;
let waiting = 0;
let round = 0;

async function look() {
  ++turn;
  try {
    const name = open?.rock.name;
    if (name) {
      const { calibration } = placeNow();
      const answer = await ask<RockAnswer>(rockAddress(name, calibration));
      if (open?.rock.name === name && placeNow().calibration === calibration) open.meet(answer);
    }
    if (!open?.running || turn % 4 === 0) project = await askProject();
    stranger.hidden = trouble.hidden = true;
    listRocks();
  } catch (error) {
    const unknown = error instanceof Refused && [401, 403].includes(error.status);
    stranger.hidden = !unknown;
    trouble.hidden = unknown || error instanceof Gone;
    trouble.textContent = (error as Error).message;
  }
}

async function watch() {
  const mine = ++round;
  await look();
  if (mine !== round) return; // another one has begun meanwhile
  const soon = open?.running ? 1000 : 4000;
  waiting = window.setTimeout(watch, document.hidden ? 4000 : away.hidden ? soon : 2000);
}

function refresh() {
  clearTimeout(waiting);
  void watch();
}

addEventListener("visibilitychange", () => document.hidden || refresh());
addEventListener("keydown", (e) => {
  if (!(e.ctrlKey || e.metaKey) || e.key.toLowerCase() !== "s") return;
  e.preventDefault();
  saving.querySelector<HTMLButtonElement>("button.main")?.click();
});
onReturn(() => void attempt(opening, arrive));

// --- what is pasted or dropped beside all fields ---------------------------------------------------------------

const isField = (target: EventTarget | null) => target instanceof Element && target.closest("input, textarea, select") !== null;
addEventListener("paste", (e) => {
  const text = e.clipboardData?.getData("text/plain") ?? "";
  if (isField(e.target) || e.defaultPrevented || text.trim() === "") return;
  e.preventDefault();
  if (open) open.table.paste(text);
  else void started.then(() => starting?.bring(text, ""));
});
addEventListener("dragover", (e) => {
  if (e.dataTransfer?.types.includes("Files")) e.preventDefault(); // else the browser opens the file in place of the page
});
addEventListener("drop", (e) => {
  const file = e.dataTransfer?.files[0];
  if (!file) return;
  e.preventDefault();
  void started.then(() => starting?.bringFile(file));
});
onDraft(
  () => (open ? [project.folder, open.rock.name] : null),
  () => {
    open!.rock.takeDraft();
    refresh();
  },
);

async function start() {
  theme(redrawLive, localStorage);
  try {
    project = await askProject();
  } catch (error) {
    stranger.hidden = error instanceof Gone;
    if (error instanceof Gone) setTimeout(() => location.reload(), 3000);
    return;
  }
  nameOptions(project.options);
  document.getElementById("subtitle")!.textContent = `Folder ${project.folder} · Phyllite ${project.version}, ${counted(project.threads, "thread")}`;
  folder.textContent = "A rock is two files of this folder: a table of tests and a rock file.";
  starting = startView(() => project, created, () => document.getElementById("calibration")!.scrollIntoView());
  contents.append(h("li", {}, h("a", { href: "#rocks" }, "Rocks")));
  document.getElementById("commands")!.append(textSwitch());
  main.append(section("rocks", "Rocks", folder, rockList, opening, first, another), place);
  arrange();
  listRocks();
  if (placeNow().rock === "" && project.rocks.length === 1) goTo({ rock: project.rocks[0].name, calibration: "" }, true);
  const wanted = placeNow().rock;
  if (wanted && !project.rocks.some((r) => r.name === wanted) && !draft(project.folder, wanted)) opening.textContent = `There is no rock ${wanted} in this folder.`;
  else await attempt(opening, arrive);
  document.documentElement.dataset.ready = "true";
  void watch();
}

const started = start();

// Any test on the calibrated rock: chosen, seen as a recipe, run.
import { Child, fold, h, table } from "../dom";
import { readable } from "../units";
import { argument, attempt, button, command, field, fileFold, fileLink, input, keyed, objections, plainly, select, stopper, textArea } from "./controls";
import { bar, clock } from "./clock";
import { liveView } from "./live";
import { chosenBefore, keepChosen } from "./drafts";
import { Brief, Key, RockTest, Project, RockAnswer, Tested, ask } from "./server";
import { get, quoted, set } from "./toml";

export interface BenchView {
  node: HTMLElement;
  show(answer: RockAnswer): void;
}

/** What else a test is called, by who looks for it. */
const alsoCalled: Record<string, string> = { uniaxial: "uniaxial compression (UCS)", biaxial: "triaxial / confined (biaxial)", brazilian: "Brazilian (BTS)", direct_tension: "direct tension (DTS)" };

/** Of every test; the rest that is of all is under "More". */
const always = ["test.angles", "test.intact"];

interface Recipe {
  toml: string | null; // null: a value is wrong
  problems: { key: string; text: string }[];
}

/** What has been chosen; kept in the browser, so that a reload loses nothing. */
interface Choices {
  kind: string;
  changes: Record<string, string>;
  name: string; // "": as proposed
  byHand: string | null; // the recipe, where it has been changed by hand
  started: string[]; // tests, in the order in which they were started here
  calibration: string; // which one is tested; "": the one that is open, or else the newest
}

const last = (path: string) => path.slice(path.lastIndexOf(".") + 1);
const tableOf = (path: string) => path.slice(0, path.lastIndexOf("."));

function label(path: string): string {
  const words = last(path).replaceAll("_", " ").replace(/^n /, "number of ");
  return words[0].toUpperCase() + words.slice(1);
}

const isNumber = (text: string) => text.trim() !== "" && Number.isFinite(Number(text));

const pascals: Record<string, number> = { Pa: 1, kPa: 1e3, MPa: 1e6, GPa: 1e9 };

/** Of a stress that a test keeps: the number in MPa, nothing for 0, which is none. */
function inMPa(value: string): string {
  const [, number, unit] = value.match(/^\s*([-+.\de]+)\s*([kMG]?Pa)\s*$/) ?? [];
  if (unit === undefined) return value;
  const stress = (Number(number) * pascals[unit]) / 1e6;
  return stress === 0 ? "" : String(+stress.toPrecision(12));
}

/** As it is typed: lists without brackets and quotes. */
const typed = (key: Key, value: string) => (key.kind === "list" ? value.replace(/[[\]"]/g, "").trim() : value);

/** Commas separate where nothing else does: "0,45" are two, and so are "22,5; 45" and "22,5 45". */
function listed(value: string): string[] {
  const apart = value.trim().split(value.includes(";") ? ";" : /,?\s+(?=[-+.\d])/).map((v) => v.trim());
  const decimal = (v: string) => v.replace(/^([+-]?\d+),(\d+)(?=$|[^,\d])/, "$1.$2");
  return (apart.length > 1 ? apart.map(decimal) : apart)
    .flatMap((v) => v.split(","))
    .map((v) => v.trim())
    .filter((v) => v !== "");
}

/** As the program takes it. `kept`: a stress, in MPa where no unit says otherwise. */
function written(key: Key, value: string, kept: boolean): string {
  const number = value.trim().replace(/^([+-]?\d+),(\d+)$/, "$1.$2");
  if (kept && isNumber(number)) return `${number} MPa`;
  if (key.kind !== "list") return value;
  const items = listed(value);
  return `[${items.map((v) => (!isNumber(v) ? quoted(v) : key.unit ? quoted(`${v} ${key.unit}`) : v)).join(", ")}]`;
}

/** As it stands in a recipe; `value`: as written() gives it. */
const asToml = (key: Key, value: string) => (["quantity", "choice", "text"].includes(key.kind) ? quoted(value) : value);

const kindsOf = (key: Key) => key.tests ?? [];

/** A name that says what is tested: biaxial-10-MPa. */
function proposal(kind: string, telling: string, taken: string[]): string {
  const base = [kind, telling].filter(Boolean).join("-").replace(/[^\w.-]+/g, "-").replaceAll("_", "-");
  let name = base;
  for (let i = 2; taken.includes(name); ++i) name = `${base}-${i}`;
  return name;
}

export function benchView(rock: string, project: Project, changed: () => void): BenchView {
  const store = `phyllite test ${project.folder} ${rock}`;
  const keys = project.keys.filter((k) => k.path !== "test.kind");
  const isKept = (k: Key) => project.kinds.some((kind) => kind.kept_stress === k.path);
  let choices: Choices = { kind: project.kinds[0]?.name ?? "uniaxial", changes: {}, name: "", byHand: null, started: [], calibration: "", ...chosenBefore<Choices>(store) };
  let recipe: Recipe | null = null;
  let chosen = ""; // the last recipe without problems
  let tested: Brief[] = []; // calibrations with a model
  let opened = ""; // the calibration that is open
  let of = ""; // which calibration the recipe is of
  let asked = 0;
  let taken: string[] = [];
  let toShow = ""; // the test that was just started

  const wrong = objections();
  const kind = select(project.kinds.map((k) => [k.name, alsoCalled[k.name] ?? k.title]), (v) => {
    change({ kind: v });
    arrange();
  });
  const base = select([], (v) => change({ calibration: v }));
  const basePlace = field("Calibration that is tested", base);
  const name = input((v) => change({ name: v }, false));
  const area = textArea((t) => change({ byHand: t }, false), { id: "test-recipe" });
  const asChosen = button("Take the recipe as chosen again", () => change({ byHand: null }));
  const handNote = h("p", { class: "muted" }, "Changed by hand: what is chosen above changes its line in this text. ", asChosen);
  const controls = new Map(keys.map((k) => [k.path, control(k)]));
  const front = h("div", { class: "fields" });
  const more = h("div", { class: "fields" });
  const general = h("ul", { class: "problems" });
  const commandPlace = h("div");
  const run = button("Run the test", () =>
    attempt(wrong, async () => {
      if (choices.byHand === null) await load(); // what was chosen last
      if (choices.byHand === null && recipe && recipe.problems.length > 0) throw new Error("some values above are wrong; mend them first");
      const started = testName();
      await ask("/api/test", { name: rock, test: started, toml: area.node.value });
      change({ name: "", started: [...choices.started.filter((t) => t !== started), started] }, false);
      toShow = started;
      changed();
    }), { class: "main" });
  const form = h(
    "div",
    {},
    h("div", { class: "fields" }, field("Kind of test", kind), basePlace),
    front,
    fold("More", more),
    general,
    h("div", { class: "field as-text" }, h("label", { for: "test-recipe" }, "Recipe"), area.node),
    handNote,
    h("div", { class: "fields" }, field("Name of the test", name)),
    h("div", { class: "tools" }, run),
    wrong,
    commandPlace,
  );
  const before = h("p", { class: "muted" }, "Tests are made on the calibrated rock: calibrate it first.");
  const done = h("div");
  const shownTests = new Map<string, ReturnType<typeof testView>>();

  function control(k: Key) {
    const node = k.kind === "boolean" ? select([["true", "yes"], ["false", "no"]], (v) => choose(k, v)) : k.kind === "choice" ? select(k.choices.map((c) => [c, c]), (v) => choose(k, v)) : input((v) => choose(k, v), { placeholder: isKept(k) ? "such as 10" : "not given" });
    const problem = h("p", { class: "objection" });
    const [only, another] = kindsOf(k); // it is seen with that kind of test alone
    const meaning = only && !another ? k.meaning.replace(`${only}: `, "") : k.meaning;
    const hint = [meaning, isKept(k) ? "above 0; in MPa, or with another unit" : k.range.replaceAll("<=", "≤")];
    const name = label(k.path) + (isKept(k) ? " [MPa]" : "");
    return { key: k, node, problem, place: h("div", {}, field(name, node, h("span", { title: k.path }, hint.filter(Boolean).join("; "))), problem) };
  }

  /** Changes by hand stay: the choice changes its line in them. */
  function choose(k: Key, value: string) {
    const wanted = written(k, value, isKept(k));
    const byHand = choices.byHand === null ? null : set(choices.byHand, tableOf(k.path), last(k.path), asToml(k, wanted));
    change({ changes: { ...choices.changes, [k.path]: wanted }, byHand });
  }

  const own = () => keys.filter((k) => kindsOf(k).includes(choices.kind));
  const telling = () => choices.changes[own().find((k) => k.kind === "quantity")?.path ?? ""] ?? "";
  const testName = () => choices.name || proposal(choices.kind, telling(), taken);

  function change(some: Partial<Choices>, anew = true) {
    if (some.kind && choices.byHand !== null) some.byHand = set(choices.byHand, "test", "kind", quoted(some.kind));
    choices = { ...choices, ...some };
    keepChosen(store, choices);
    if (anew) void fetchRecipe();
    draw();
  }

  function calibration(): string {
    const has = (folder: string) => tested.some((b) => b.folder === folder);
    return has(choices.calibration) ? choices.calibration : has(opened) ? opened : (tested[0]?.folder ?? "");
  }

  async function load() {
    const mine = ++asked;
    const answer = await ask<Recipe>("/api/recipe", { name: rock, calibration: calibration(), changes: { "test.kind": choices.kind, ...relevant() } });
    if (mine !== asked) return;
    recipe = answer;
    chosen = answer.toml ?? chosen;
    draw();
  }

  async function fetchRecipe() {
    await attempt(wrong, load);
    if (document.activeElement !== area.node) area.reveal(area.node.value.split("\n").indexOf("[test]"));
  }

  const applies = (k: Key) => always.includes(k.path) || kindsOf(k).length === 0 || own().includes(k);

  /** What was chosen for another kind of test is not said of this one. */
  function relevant(): Record<string, string> {
    return Object.fromEntries(keys.filter((k) => applies(k) && choices.changes[k.path]).map((k) => [k.path, choices.changes[k.path]]));
  }

  function arrange() {
    const shown = keys.filter(applies);
    const upFront = (k: Key) => always.includes(k.path) || own().includes(k);
    const places = (some: Key[]) => some.map((k) => controls.get(k.path)!.place);
    front.replaceChildren(...places(shown.filter(upFront)));
    more.replaceChildren(...places(shown.filter((k) => !upFront(k))));
  }

  function draw() {
    kind.value = choices.kind;
    const text = choices.byHand ?? chosen;
    area.set(text);
    handNote.hidden = choices.byHand === null;
    for (const c of controls.values()) {
      const said = recipe?.problems.filter((p) => p.key === c.key.path).map((p) => p.text) ?? [];
      const inRecipe = typed(c.key, said.length > 0 ? (choices.changes[c.key.path] ?? "") : get(text, tableOf(c.key.path), last(c.key.path)));
      const value = !isKept(c.key) ? inRecipe : said.length > 0 ? inRecipe.replace(/ MPa$/, "") : inMPa(inRecipe);
      if (document.activeElement !== c.node && c.node.value !== value) c.node.value = value;
      c.problem.textContent = plainly(said.join(" "));
      c.node.setAttribute("aria-invalid", String(said.length > 0));
    }
    const rest = recipe?.problems.filter((p) => !controls.has(p.key)) ?? [];
    keyed(general, rest, () => rest.map((p) => h("li", {}, p.key && `${p.key}: `, p.text)));
    if (document.activeElement !== name) name.value = testName();
    const file = `${rock}-tests/${testName()}`;
    keyed(commandPlace, file, () => [command(`phyllite run ${argument(`${file}.toml`)} --out ${argument(file)}`), h("p", { class: "muted as-text" }, "The recipe is saved as ", h("code", {}, `${file}.toml`))]);
  }

  function showTests(tests: RockTest[]) {
    for (const [known, view] of shownTests) if (!tests.some((t) => t.name === known) && shownTests.delete(known)) view.node.remove();
    const order = (t: RockTest) => choices.started.indexOf(t.name);
    for (const t of [...tests].sort((a, b) => order(a) - order(b))) {
      if (!shownTests.has(t.name)) {
        shownTests.set(t.name, testView(rock, t.name, changed));
        done.prepend(shownTests.get(t.name)!.node); // the newest first
      }
      shownTests.get(t.name)!.show(t);
    }
    if (!shownTests.has(toShow)) return;
    shownTests.get(toShow)!.node.scrollIntoView({ block: "start" });
    toShow = "";
  }

  arrange();
  return {
    node: h("div", {}, before, form, done),
    show(answer) {
      tested = answer.calibrations.filter((b) => b.tested);
      opened = answer.calibration.folder;
      const calibrated = tested.length > 0;
      basePlace.hidden = tested.length < 2;
      keyed(base, tested.map((b) => b.folder), () => tested.map((b) => h("option", { value: b.folder }, `${b.folder}${b.verdict.status ? `: ${b.verdict.status}` : ""}`)));
      base.value = calibration();
      before.hidden = calibrated;
      form.hidden = !calibrated;
      const version = JSON.stringify([calibration(), tested.find((b) => b.folder === calibration())?.errors]);
      if (calibrated && version !== of) void fetchRecipe();
      if (calibrated) of = version;
      taken = answer.tests.map((t) => t.name);
      showTests(answer.tests);
      if (calibrated) draw();
    },
  };
}

/** "kinetic_ratio 0.02, above 0.01: why" with the reason first. */
const reasonFirst = (note: string) => note.replace(/^(\w+) ([^:]+): (.*)$/s, (_, number: string, found: string, why: string) => `${why} (${number.replaceAll("_", " ")} ${found})`);

/** A number that is not to be trusted says so where it stands. */
function value(s: Tested): Child {
  const notes = (s.notes ?? []).map(reasonFirst).join("; ");
  const doubt = s.grade && s.grade !== "good" ? `, ${s.grade}` : "";
  const [factor, name] = s.value != null && s.unit ? readable(s.value, s.unit) : [1, ""];
  const number = s.value != null && s.unit ? `${(s.value * factor).toPrecision(4)} ${name}`.trim() : "–";
  if (s.grade === "untrusted") return h("span", { class: "untrusted" }, `${number}${doubt}${notes && `: ${notes}`}`);
  return h("span", {}, `${number}${doubt}`, notes && h("small", {}, notes));
}

function specimens(t: RockTest): Child {
  if (t.specimens.length === 0) return null;
  return table(`Results of ${t.name}`, ["specimen", "θ [°]", "strength", "value", "outcome"], t.specimens.map((s) => [s.specimen, s.theta === null ? "–" : String(s.theta), s.strength ?? "–", value(s), s.status]), null, [3]);
}

function testState(t: RockTest): string {
  if (t.state === "new") return "Not run yet.";
  if (t.state === "failed") return `Ended with an error${t.exit_code === null ? "" : ` (exit code ${t.exit_code})`}; the output says why.`;
  return `${t.state[0].toUpperCase()}${t.state.slice(1)}.`;
}

/** A test that has been run, or is. */
function testView(rock: string, name: string, changed: () => void) {
  const wrong = objections();
  const state = h("p", { class: "state", role: "status" });
  const [results, rest] = [h("div"), h("div")];
  const id = `test-${name}`;
  const [busy, time] = [bar(`Specimens of ${name}`), clock()];
  const going = h("div", {}, busy.node, h("p", { class: "muted" }, time.node));
  const live = liveView();
  const log = h("pre", { tabindex: "0" });
  const output = fold("Output of the program", log);
  const files = fileFold();
  const stop = stopper("Stop the test", wrong, async () => {
    await ask("/api/stop", { name: rock, test: name });
    changed();
  });
  const run = button(`Run ${name}`, () =>
    attempt(wrong, async () => {
      await ask("/api/test", { name: rock, test: name, toml: null }); // the recipe as it lies there
      changed();
    }),
  );
  return {
    node: h("article", { id, "aria-label": `Test ${name}` }, h("h3", {}, h("a", { href: `#${encodeURIComponent(id)}` }, name)), state, going, live.node, h("div", { class: "tools" }, run, ...stop.nodes), wrong, results, rest, files.node, output),
    show(t: RockTest) {
      const report = t.files.find((f) => f.endsWith("report.html"));
      keyed(state, [t.state, t.exit_code], () => [testState(t)]);
      going.hidden = t.state !== "running";
      live.follow(t.state === "running" ? `/api/press?name=${encodeURIComponent(rock)}&test=${encodeURIComponent(name)}` : null);
      time.show(t.seconds);
      stop.show(t.state === "running");
      run.hidden = !["new", "stopped"].includes(t.state);
      keyed(results, t.specimens, () => [specimens(t)]);
      keyed(rest, [report, t.command], () => [report ? h("p", {}, fileLink(report, `Open the report of ${name}`)) : null, command(t.command)]);
      files.show(t.files);
      output.hidden = t.log === "";
      if (t.state === "failed" && log.textContent !== t.log) output.open = true;
      if (log.textContent !== t.log) log.textContent = t.log;
    },
  };
}

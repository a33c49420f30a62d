// A calibration: started, watched, stopped, gone on with, read.
import { Child, fold, h, table } from "../dom";
import { draw } from "../figure";
import { narrowing } from "./charts";
import { bar, between, clock, duration } from "./clock";
import { argument, attempt, button, command, counted, field, fileFold, fileLink, input, keyed, objections, plainly, stopper, worded } from "./controls";
import { Figures } from "./figures";
import { liveView } from "./live";
import { OptionForm, optionForm } from "./options";
import { Rock } from "./rock";
import { Brief, Calibrating, Checked, Progress, Project, RockAnswer, ask } from "./server";
import { get } from "./toml";

export interface CalibrationView {
  node: HTMLElement;
  show(answer: RockAnswer, now: Pick<Rock, "dirty" | "gone" | "text">): void; // gone: there are no files to read
  mark(checked: Checked): void;
}

/** What a calibration does to the rest of the page. */
export interface Around {
  ready: () => Promise<void>; // saves what has to be saved; it throws where that cannot be
  changed: () => void;
  choose: (folder: string) => void; // opens another calibration of the rock
  grains: (size: string | null) => void; // null: as the program proposes
}

/** Has left no word on how it goes yet. */
const justBegun: Progress = { state: "running", stage: "", seconds: 0, n_done: 0, n_total: 0, model: [0, 1], stages: [0, 0, 0], seconds_left: null, said: [], parameters: [] };

function state(c: Calibrating): string {
  switch (c.state) {
    case "new":
      return "Not calibrated yet.";
    case "running":
      return c.here ? "Running." : "Running, started elsewhere.";
    case "stopped":
      return "Stopped; what is finished is kept.";
    case "failed":
      return `Ended with an error${c.exit_code === null ? "" : ` (exit code ${c.exit_code})`}; the output says why.`;
    case "finished":
      return "Finished.";
  }
}

/** `rock`: whose calibration it is. */
function watch(rock: string) {
  const stage = h("p", { class: "stage" });
  const done = bar("Tests of this stage");
  const [tests, left, time] = [h("span"), h("span"), clock()];
  const live = liveView();
  const parameters = new Figures("grid parameters");
  const heading = h("h3", {}, "Parameters: estimate and 95 % interval, step by step, inside the values admitted");
  return {
    node: h("div", { class: "watch" }, h("div", {}, stage, done.node, h("p", { class: "muted" }, tests, time.node, left)), live.node, heading, parameters.node),
    /** `seconds`: of what runs in `folder`; null: nothing does. */
    show(left_behind: Progress, seconds: number | null, folder: string) {
      const p = { ...justBegun, ...left_behind }; // files of earlier versions say less
      const running = seconds !== null;
      stage.textContent = p.state === "finished" ? "" : p.stage;
      done.node.hidden = !running;
      done.show(p.n_done, p.n_total);
      time.show(seconds);
      tests.textContent = running && p.n_total > 0 ? `${p.n_done} of ${p.n_total} tests of this stage. ` : "";
      const [model, models] = p.model, [kth, least, most] = p.stages;
      const place = kth > 0 ? `${model > 0 && models > 1 ? `model ${model} of at most ${models}, ` : ""}stage ${kth} of ${least === most ? most : `${least} to ${most}`}, ` : "";
      const known = place + (!Array.isArray(p.seconds_left) ? "time left not known yet" : `${between(...p.seconds_left)} left`);
      left.textContent = running ? `, ${known}.` : `It took ${duration(p.seconds)}.`;
      live.follow(running ? `/api/press?name=${encodeURIComponent(rock)}&calibration=${encodeURIComponent(folder)}` : null);
      const some = p.parameters.filter((x) => x.steps.length > 0);
      heading.hidden = some.length === 0;
      parameters.show(some.map((x) => ({ name: x.symbol, shown: x, draw: (width) => draw(narrowing(x), width, { aspect: 0.4 }).node })));
    },
  };
}

/** `anew`: writes the report again, with what the rock file says of its first page now. */
function verdict(c: Calibrating, anew: () => void): Child[] {
  if (!c.verdict) return [];
  const good = c.verdict.status.startsWith("calibrated");
  const report = c.files.find((f) => f.endsWith("report.html"));
  const list = (items: string[]) => h("ul", { class: "findings" }, ...items.map((s) => h("li", {}, ...worded(s, c.files))));
  return [
    h("p", { class: good ? "notice verdict" : "notice" }, h("strong", {}, ...worded(c.verdict.sentence, c.files))),
    report ? h("p", { class: "tools" }, fileLink(report, "Open the report"), button("Write the report anew", anew, { class: "link" })) : null,
    report ? command(`phyllite report ${argument(c.folder)}`) : null,
    list(c.verdict.lines ?? []), // files of earlier versions have none
    c.verdict.findings.length > 0 && fold(counted(c.verdict.findings.length, "finding"), list(c.verdict.findings.map((f) => f.text))),
  ];
}

/** How far the model is off, on packings that the fit has not seen where there are such. */
function errors(b: Brief): Child {
  const row = b.errors.find((e) => e.of.includes("unseen")) ?? b.errors[0];
  if (!row) return "–";
  const said = (value: number, property: string) => (property === "nu" ? value.toFixed(3) : `${(100 * value).toFixed(1)}\u00a0%`);
  return Object.entries(row).flatMap(([property, value]) => (typeof value === "number" ? [`${property} ${said(value, property)}`] : [])).join(", ");
}

/** All calibrations of a rock, one of them open. */
function calibrationList(all: Brief[], openOne: string, choose: (folder: string) => void): HTMLElement {
  const one = (b: Brief) => {
    const link = button(b.folder, () => choose(b.folder), { class: "link" });
    if (b.folder === openOne) link.setAttribute("aria-current", "true");
    return link;
  };
  return table(
    "Calibrations of this rock",
    ["calibration", "begun", "state", "effort", "verdict", "error"],
    all.map((b) => [one(b), `${duration(b.began)} ago`, b.state, b.effort ?? "–", b.verdict.status ?? "–", errors(b)]),
    "Calibrations of this rock, the newest first",
    [1, 2, 3, 4, 5],
  );
}

/** "1,2" and "1.2" are in millimetres. */
const asSize = (text: string) => (/^\d+([.,]\d+)?$/.test(text.trim()) ? `${text.trim().replace(",", ".")} mm` : text.trim());

/** What to expect before anything runs: tests and time by the effort, the errors by the maps. */
function beforehand(options: OptionForm, grains: Around["grains"]) {
  const size = input((v) => grains(v.trim() === "" ? null : asSize(v)), { placeholder: "as the program proposes" });
  const hint = h("span");
  const place = field("Grain size of the model [mm]", size, hint);
  const errors = h("p");
  return {
    fields: place,
    errors,
    show(toml: string) {
      const said = get(toml, "", "grain_size");
      if (document.activeElement !== size) size.value = said.replace(/\s*mm$/, "");
      size.disabled = get(toml, "", "recipe") !== "";
    },
    mark(c: Checked) {
      options.annotate("effort", Object.fromEntries(c.course.map(({ effort, numbers: n }) => [effort, [between(n.least_seconds, n.most_seconds), `${n.least_tests} to ${n.most_tests} tests, ${between(n.least_seconds, n.most_seconds)}`]])));
      const of = c.grains && `${c.grains.number} grains of ${(1e3 * c.grains["diameter [m]"]).toPrecision(3)} mm. `;
      hint.textContent = `${of ?? ""}${size.disabled ? "The recipe says it." : "Half the size: about eight times as long."}`;
      keyed(errors, c.forecast, () => (c.forecast.length > 0 ? [h("strong", {}, "To be expected: "), plainly(c.forecast[0].text)] : []));
    },
  };
}

export function calibrationView(rock: string, project: Project, { ready, changed, choose, grains }: Around): CalibrationView {
  let now: Calibrating | null = null;
  let opened = ""; // its folder; "": it is not there yet
  const options = optionForm(project.options, `phyllite calibration ${project.folder} ${rock}`, () => describe());
  const ahead = beforehand(options, grains);
  options.node.prepend(ahead.fields);
  const wrong = objections();
  const place = { state: h("p", { class: "state", role: "status" }), verdict: h("div"), command: h("div"), log: h("pre", { tabindex: "0" }) };
  const output = fold("Output of the program", place.log);
  const files = fileFold();
  const live = watch(rock);
  const list = h("div");

  const begin = (how: { resume?: boolean; anew?: boolean }) =>
    attempt(wrong, async () => {
      if (!how.resume && options.wrong()) throw new Error("an option has no value that it can have; mend it first");
      await ready();
      await ask("/api/calibrate", { name: rock, calibration: how.anew ? "" : opened, options: options.asked(), resume: false, anew: false, ...how });
      if (how.anew) choose(""); // the newest
      changed();
    });
  const start = button("Start calibration", () => begin({}), { class: "main" });
  const goOn = button("Go on", () => begin({ resume: true }), { class: "main" });
  const again = button("Calibrate anew", () => begin({ anew: true }));
  const anew = () =>
    void attempt(wrong, async () => {
      await ready();
      await ask("/api/report", { name: rock, calibration: opened });
      changed();
    });
  const stop = stopper("Stop", wrong, async () => {
    await ask("/api/stop", { name: rock, test: null, calibration: opened });
    changed();
  });

  /** What the buttons would start; of what runs or ran, what it was. */
  function describe() {
    if (!now) return;
    const begin = (folder: string) => `phyllite calibrate ${argument(`${rock}.toml`)} --out ${argument(folder)}${options.words()}`;
    const lead = goOn.hidden ? "As a command: " : "To go on, as a command: ";
    const commands: [string, string][] = [];
    if (start.hidden) commands.push([now.command, lead]);
    else if (!options.wrong()) commands.push([begin(now.folder), lead]);
    if (!again.hidden && !options.wrong()) commands.push([begin(now.next), "Anew, in another folder, as a command: "]);
    keyed(place.command, commands, () => commands.filter(([text]) => text).map(([text, lead]) => command(text, lead)));
  }

  return {
    node: h("div", {}, list, place.state, place.verdict, options.node, ahead.errors, h("div", { class: "tools" }, start, goOn, again, ...stop.nodes), wrong, live.node, place.command, files.node, output),
    mark: ahead.mark,
    show(answer, { dirty, gone, text }) {
      ahead.show(text.toml);
      const { calibration: c, calibrations } = answer;
      now = c;
      opened = calibrations.some((b) => b.folder === c.folder) ? c.folder : "";
      const minutes = calibrations.map((b) => [b.folder, b.state, b.verdict.status, Math.round(b.began / 60)]);
      list.hidden = calibrations.length < 2;
      if (!list.hidden) keyed(list, [minutes, c.folder], () => [calibrationList(calibrations, c.folder, choose)]);
      const elsewhere = calibrations.some((b) => b.state === "running" && b.folder !== c.folder); // one at a time
      const running = c.state === "running";
      keyed(place.state, [c.state, c.here, c.exit_code], () => [state(c)]);
      options.node.hidden = ahead.errors.hidden = running || gone;
      // a start that failed at once has left nothing to go on with
      start.hidden = gone || !(c.state === "new" || (c.state === "failed" && !c.resumes));
      start.textContent = dirty ? "Save and start calibration" : "Start calibration";
      goOn.hidden = gone || !(c.state === "stopped" || (c.state === "failed" && c.resumes));
      again.hidden = gone || running || !start.hidden;
      for (const b of [start, goOn, again]) b.disabled = elsewhere;
      stop.show(running);
      describe();
      const progress = c.progress?.state === "running" || !running ? c.progress : justBegun; // else of the run before
      live.node.hidden = progress === null;
      if (progress) live.show(progress, c.seconds, c.folder);
      keyed(place.verdict, [c.verdict, c.files], () => verdict(c, anew));
      files.show(c.files);
      const log = c.log || (c.progress?.said ?? []).join("\n"); // one that was started elsewhere has left no output
      output.hidden = log === "";
      if (c.state === "failed" && place.log.textContent !== log) output.open = true;
      if (place.log.textContent !== log) place.log.textContent = log;
    },
  };
}

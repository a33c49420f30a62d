// A calibration: started, watched, stopped, gone on with, read.
import { Child, fold, h } from "../dom";
import { growing, narrowing } from "./charts";
import { argument, attempt, button, command, counted, field, fileFold, fileLink, input, keyed, objections, ticked } from "./controls";
import { Figures } from "./figures";
import { Calibrating, Progress, ask } from "./server";

export interface CalibrationView {
  node: HTMLElement;
  show(c: Calibrating, dirty: boolean): void;
}

const usual = 1000;

/** The folder of the calibration after this one: rock-calibration-2. */
const next = (folder: string) => folder.replace(/(?:-(\d+))?$/, (_, n?: string) => `-${Number(n ?? 1) + 1}`);

/** Seconds as somebody would say them. */
function duration(seconds: number): string {
  if (seconds < 90) return `${Math.round(seconds)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

function state(c: Calibrating): string {
  switch (c.state) {
    case "new":
      return "Not calibrated yet.";
    case "running":
      return c.here ? "Running." : "Running, started elsewhere: it is stopped there.";
    case "stopped":
      return "Stopped; what is finished is kept.";
    case "failed":
      return `Ended with an error${c.exit_code === null ? "" : ` (exit code ${c.exit_code})`}; the output says why.`;
    case "finished":
      return "Finished.";
  }
}

function watch() {
  const stage = h("p", { class: "stage" });
  const bar = h("progress", { max: "1", "aria-label": "Tests of this stage" });
  const time = h("p", { class: "muted" });
  const press = new Figures("grid small");
  const parameters = new Figures("grid parameters");
  const heading = h("h3", {}, "Parameters: estimate and 95 % interval, step by step, inside the values admitted");
  return {
    node: h("div", { class: "watch" }, h("div", {}, stage, bar, time), press.node, heading, parameters.node),
    show(p: Progress, running: boolean) {
      stage.textContent = p.state === "finished" ? "" : p.stage;
      bar.hidden = !running;
      bar.max = Math.max(1, p.n_total);
      bar.value = p.n_done;
      const left = p.seconds_left === null ? "time left not known yet" : `about ${duration(p.seconds_left)} left`;
      const tests = p.n_total > 0 ? `${p.n_done} of ${p.n_total} tests of this stage, ` : "";
      time.textContent = running ? `${tests}${duration(p.seconds)} so far, ${left}` : `It took ${duration(p.seconds)}.`;
      const now = running ? p.pressed : null;
      press.show(now ? [{ name: "In the press now", caption: [now.test.replaceAll("_", " "), now.specimen ?? (now.theta == null ? null : `θ = ${now.theta}°`)].filter(Boolean).join(", "), shown: now, draw: (width) => growing(now, width) }] : []);
      const some = p.parameters.filter((x) => x.steps.length > 0);
      heading.hidden = some.length === 0;
      parameters.show(some.map((x) => ({ name: x.symbol, shown: x, draw: (width) => narrowing(x, width) })));
    },
  };
}

function verdict(c: Calibrating): Child[] {
  if (!c.verdict) return [];
  const good = c.verdict.status.startsWith("calibrated");
  const report = c.files.find((f) => f.endsWith("report.html"));
  const list = (items: string[]) => h("ul", { class: "findings" }, ...items.map((s) => h("li", {}, s)));
  return [
    h("p", { class: good ? "notice verdict" : "notice" }, h("strong", {}, c.verdict.sentence || c.verdict.status)),
    report ? h("p", {}, fileLink(report, "Open the report")) : null,
    c.verdict.summary.length > 0 && list(c.verdict.summary),
    c.verdict.findings.length > 0 && fold(counted(c.verdict.findings.length, "finding"), list(c.verdict.findings)),
  ];
}

/** `ready` saves what has to be saved; it throws where that cannot be. */
export function calibrationView(rock: string, ready: () => Promise<void>, changed: () => void): CalibrationView {
  let now: Calibrating | null = null;
  const most = input(() => describe(), { type: "number", min: "1", step: "1" });
  most.value = String(usual);
  const elastic = h("input", { type: "checkbox" });
  elastic.addEventListener("change", () => describe());
  const wrong = objections();
  const place = { state: h("p", { class: "state", role: "status" }), verdict: h("div"), command: h("div"), log: h("pre", { tabindex: "0" }) };
  const output = fold("Output of the program", place.log);
  const files = fileFold();
  const live = watch();

  const begin = (how: { resume?: boolean; anew?: boolean }) =>
    attempt(wrong, async () => {
      await ready();
      await ask("/api/calibrate", { name: rock, max_tests: Number(most.value) || usual, elastic: elastic.checked, resume: false, anew: false, ...how });
      changed();
    });
  const start = button("Start calibration", () => begin({}), { class: "main" });
  const goOn = button("Go on", () => begin({ resume: true }), { class: "main" });
  const again = button("Calibrate anew", () => begin({ anew: true }));
  const stop = button("Stop", () =>
    attempt(wrong, async () => {
      await ask("/api/stop", { name: rock, test: null });
      changed();
    }),
  );
  const options = h("div", { class: "fields" }, field("Largest number of tests", most), ticked("Moduli alone (elastic stage)", elastic));

  /** What the buttons would start; of what runs or ran, what it was. */
  function describe() {
    if (!now) return;
    const most_tests = Number(most.value) || usual;
    const begin = (folder: string) => `phyllite calibrate ${argument(`${rock}.toml`)} --out ${argument(folder)} --max-tests ${most_tests}${elastic.checked ? " --elastic" : ""}`;
    const lead = goOn.hidden ? "As a command: " : "To go on, as a command: ";
    const commands = [[start.hidden ? now.command : begin(now.folder), lead]];
    if (!again.hidden) commands.push([begin(next(now.folder)), "Anew, in another folder, as a command: "]);
    keyed(place.command, commands, () => commands.map(([text, lead]) => command(text, lead)));
  }

  return {
    node: h("div", {}, place.state, place.verdict, options, h("div", { class: "tools" }, start, goOn, again, stop), wrong, place.command, live.node, files.node, output),
    show(c, dirty) {
      now = c;
      const running = c.state === "running";
      keyed(place.state, [c.state, c.here, c.exit_code], () => [state(c)]);
      options.hidden = running;
      const begun = c.command.includes(" --resume"); // a start that failed at once has left nothing
      start.hidden = !(c.state === "new" || (c.state === "failed" && !begun));
      start.textContent = dirty ? "Save and start calibration" : "Start calibration";
      goOn.hidden = !(c.state === "stopped" || (c.state === "failed" && begun));
      again.hidden = running || !start.hidden;
      stop.hidden = !running || !c.here;
      describe();
      live.node.hidden = c.progress === null;
      if (c.progress) live.show(c.progress, running);
      keyed(place.verdict, [c.verdict, c.files], () => verdict(c));
      files.show(c.files);
      const log = c.log || (c.progress?.said ?? []).join("\n"); // one that was started elsewhere has left no output
      output.hidden = log === "";
      if (c.state === "failed" && place.log.textContent !== log) output.open = true;
      if (place.log.textContent !== log) place.log.textContent = log;
    },
  };
}

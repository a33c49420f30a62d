// Lays the page out and ties the slider, the specimens and the curves together.
import { Calibration, Comparison, Estimate, Column, Line, Report, Test, Yardstick, lastUpTo, readReport, readScene } from "./data";
import { Child, Chart, check, choice, copyButton, figure, fold, h, labelled, table as plainTable, theme } from "./dom";
import { Drawn, Figure, Panel, axisLabel, draw, legend } from "./figure";
import { labelSpecimens } from "./labels";
import { paperFoot, printing } from "./paper";
import { allTables, chartSavers, savable, saveFile, saver } from "./save";
import { friendly, readable } from "./units";
import { Field, ramps } from "./painter";
import { Viewer } from "./viewer";

const report: Report = readReport();
const main = document.getElementById("main")!;
const contents = document.getElementById("contents")!;

function section(id: string, title: string, ...children: Child[]): HTMLElement {
  const s = h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), ...children);
  main.append(s);
  contents.append(h("li", {}, h("a", { href: `#${id}` }, title)));
  return s;
}

const table = (...of: Parameters<typeof plainTable>) => savable(plainTable(...of));

/** Charts that are drawn anew when their place changes its width. */
const charts: Chart[] = [];
const observer = new ResizeObserver(() => opened && redraw());
let opened = false; // the charts below the first come one by one, after the page has opened

function redraw(always = false, some = charts) {
  for (const c of some) c.redraw(always);
}

async function drawRest() {
  for (const c of charts) {
    await new Promise((next) => setTimeout(next));
    c.redraw();
  }
  opened = true;
  update();
}

function chart(label: string, caption: Child, draw: (width: number, place: HTMLElement) => Node): HTMLElement {
  const made = figure(label, caption, draw);
  charts.push(made);
  observer.observe(made.place);
  made.node.append(chartSavers(made.place, `${report.name} ${label}`));
  return made.node;
}

/** As many as a laboratory gives. */
const threeDigits = (v: number) => (Math.abs(v) >= 99.95 ? v.toFixed(0) : Math.abs(v) >= 9.995 ? v.toFixed(1) : Math.abs(v) >= 0.9995 ? v.toFixed(2) : v.toFixed(3));

const heading = (p: Panel) => [p.framed && axisLabel(p.y), p.title].filter(Boolean).join(", ").replace(/^[a-z](?=[a-z])/, (letter) => letter.toUpperCase());

/** A panel of a figure, under its own heading. */
const panelChart = (figure: Figure, p: Panel): HTMLElement => chart(heading(p), p.caption || null, (width) => draw(p, width, { aspect: figure.aspect, bare: p.framed }).node);

/** All panels of a figure, and what their signs mean. */
const grid = (figure: Figure, style = "grid small", panels = figure.panels): HTMLElement => h("div", { class: style }, ...panels.map((p) => panelChart(figure, p)));

// --- what is missing ----------------------------------------------------------------------------------------

const leastBeyond = 0.05; // of a limit: what is nearer to it changes no reading

/** What is warned of in tests that count, each once with the tests that it is said of. */
function warnings(): [string, string[]][] {
  const told = new Map<string, string[]>();
  for (const t of report.tests.filter((t) => t.outcome.status === "peaked"))
    for (const m of t.quality.marks) {
      // Of a calibration E and nu are means over packings, and may be those of small strain: here the star in the table of the specimen says it.
      if (report.calibration && m.of?.length) continue;
      if (Math.abs(m.value - m.limit) <= leastBeyond * Math.abs(m.limit)) continue;
      const says = `${m.number} ${m.least ? "below" : "above"} ${m.limit}: ${m.meaning}; ${m.advice}`;
      told.set(says, [...(told.get(says) ?? []), `${t.name}: ${m.value.toPrecision(2)}`]);
    }
  return [...told];
}

function notices(): Child[] {
  const failed = report.tests.filter((t) => t.outcome.status !== "peaked");
  const about = (t: Test) => [t.outcome.reason, t.outcome.advice].filter((s) => s.length > 0).join("; ");
  return [
    ...failed.map((t) => h("p", { class: "notice" }, h("strong", {}, `${t.name}: ${t.outcome.status}. `), about(t))),
    ...report.missing.map((m) => h("p", { class: "notice" }, h("strong", {}, `${m.name}: missing. `), m.reason)),
  ];
}

/** What can stay as it is is said last. */
function reservations() {
  const all = warnings();
  if (all.length > 0) section("reservations", "Warnings", ...all.map(([says, names]) => h("p", { class: "warning" }, `${says} (${names.join(", ")})`)));
}

// --- slider, specimens, curves ------------------------------------------------------------------------------

let position = 1; // 0 start, 1 end
let equalStrain = true;
let selected: number | null = null;
let viewer: Viewer | null = null;
const longest = Math.max(1e-9, ...report.tests.map((t) => t.end));
const strainsNow = () => report.tests.map((t) => Math.min(t.end, position * (equalStrain ? longest : t.end)));

let overview: Drawn | null = null;
const dots: HTMLElement[] = [];
const multiples: { chart: Drawn; dot: HTMLElement; test: number }[] = [];
const feet: HTMLElement[] = [];
const slider = h("input", { type: "range", min: "0", max: "1000", value: "1000", step: "1", id: "slider", "aria-label": "Position in the test" });
const readout = h("output", { for: "slider" });

/** Stress of a test at a strain, straight between the points of its curve [MPa]. */
function stressAt(t: Test, strain: number): number {
  const [x, y] = [t.curve?.x ?? [], (t.curve?.y ?? []) as number[]];
  const at = report.axes.strain_factor * strain;
  const i = lastUpTo(x, at);
  if (i < 0 || i + 1 >= x.length) return y[Math.max(0, i)] ?? 0;
  return y[i] + ((at - x[i]) / (x[i + 1] - x[i] || 1)) * (y[i + 1] - y[i]);
}

function setDot(dot: HTMLElement, c: Drawn, t: Test, strain: number) {
  const [x, y] = [c.x(report.axes.strain_factor * strain), c.y(stressAt(t, strain))];
  dot.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
}

/** What a specimen was tested for, and what the laboratory has there. */
function strengthOf(t: Test): string[] {
  const made = report.columns.find((c) => c.made_for);
  const number = made && t.numbers[made.number];
  if (!made || !number) return [];
  const same = (r: Comparison) => r.property === made.head && r["theta [deg]"] === t.theta && !r["confining [Pa]"];
  const measured = report.calibration?.fitted.find(same);
  const shown = (value: number) => `${threeDigits(value * made.scale)} ${made.unit}`;
  return [number.value === null ? `${made.head} –` : `${made.head} ${shown(number.value)}`, ...(measured ? [`table ${shown(measured.laboratory.mean)}`] : [])];
}

/** Brings everything to the slider's position. */
function update() {
  const strains = strainsNow();
  viewer?.show(strains);
  report.tests.forEach((t, i) => {
    if (overview && dots[i]) setDot(dots[i], overview, t, strains[i]);
    if (feet[i]) {
      const cracks = lastUpTo(t.cracks.strain, strains[i]) + 1;
      feet[i].textContent = `${stressAt(t, strains[i]).toFixed(1)} MPa, ${cracks} cracks`;
    }
  });
  for (const m of multiples) setDot(m.dot, m.chart, report.tests[m.test], strains[m.test]);
  readout.textContent = equalStrain ? `${report.axes.strain} ${(report.axes.strain_factor * position * longest).toPrecision(3)} ${report.axes.strain_unit}` : `${(100 * position).toFixed(1)} % of each test`;
  slider.setAttribute("aria-valuetext", readout.textContent);
}

function moveTo(p: number) {
  position = Math.min(1, Math.max(0, p));
  slider.value = String(Math.round(1000 * position));
  update();
}

function select(test: number | null) {
  selected = selected === test ? null : test;
  document.querySelectorAll<HTMLElement>("[data-test]").forEach((b) => b.setAttribute("aria-pressed", String(Number(b.dataset.test) === selected)));
  redraw(true);
  update();
}

function playButton(): HTMLElement {
  const button = h("button", { type: "button", id: "play" });
  const show = (what: "Play" | "Pause") => {
    button.replaceChildren(h("i", { class: what.toLowerCase(), "aria-hidden": "true" }), ` ${what}`); // drawn: not every font has the signs
    button.setAttribute("aria-label", `${what} the test`);
  };
  let running = false;
  let last = 0;
  const tick = (now: number) => {
    if (!running) return;
    const step = last === 0 ? 0 : (now - last) / 9000;
    last = now;
    moveTo(position + step);
    if (position >= 1) stop();
    else requestAnimationFrame(tick);
  };
  const stop = () => {
    running = false;
    show("Play");
  };
  show("Play");
  button.addEventListener("click", () => {
    if (running) return stop();
    running = true;
    last = 0;
    if (position >= 1) moveTo(0);
    show("Pause");
    requestAnimationFrame(tick);
  });
  return button;
}

function fieldLegend(v: Viewer, place: HTMLElement) {
  place.replaceChildren();
  if (v.state.field === "bedding") return;
  const micrometres = (1e6 * v.range()).toFixed(0);
  const signed = v.state.field !== "magnitude";
  const ramp = (signed ? ramps.signed : ramps.magnitude).join(",");
  place.append(
    h("span", {}, signed ? `−${micrometres}` : "0"),
    h("i", { class: "ramp", style: `background: linear-gradient(90deg, ${ramp})` }),
    h("span", {}, `${micrometres} µm displacement`),
  );
}

function viewControls(v: Viewer, legend: HTMLElement): HTMLElement {
  const set = (change: () => void) => {
    change();
    fieldLegend(v, legend);
    v.draw();
  };
  const zoom = (factor: number) => set(() => (v.state.zoom = Math.min(40, Math.max(1, v.state.zoom * factor))));
  const button = (text: string, label: string, act: () => void) => {
    const b = h("button", { type: "button", "aria-label": label }, text);
    b.addEventListener("click", act);
    return b;
  };
  const magnify = h("input", { type: "range", min: "0", max: "100", value: "0", id: "magnify" });
  const factor = h("span", {}, "× 1");
  magnify.addEventListener("input", () =>
    set(() => {
      v.state.magnify = Math.round(Math.pow(50, Number(magnify.value) / 100));
      factor.textContent = `× ${v.state.magnify}`;
    }),
  );
  const only = choice(
    [["", "all, side by side"], ...report.tests.map((t, i): [string, string] => [String(i), t.name])],
    (value) => {
      v.state.only = value === "" ? null : Number(value);
      v.layout();
    },
    "only",
  );
  return h(
    "div",
    { class: "controls" },
    labelled("Show", only),
    labelled("Colour", choice([["bedding", "bedding"], ["magnitude", "displacement"], ["horizontal", "displacement, horizontal"], ["vertical", "displacement, vertical"]], (value) => set(() => (v.state.field = value as Field)), "field")),
    labelled("Cracks", check("show-cracks", true, (on) => set(() => (v.state.cracks = on)))),
    v.drawsForces && labelled("Contact forces", check("show-forces", false, (on) => set(() => (v.state.forces = on)))),
    labelled("Movement", magnify),
    factor,
    h("span", {}, button("+", "Zoom in", () => zoom(1.5)), " ", button("−", "Zoom out", () => zoom(1 / 1.5)), " ", button("Reset view", "Reset the view", () => set(() => Object.assign(v.state, { zoom: 1, x: 0, y: 0 })))),
  );
}

/** Dragging pans, the wheel with a modifier and two fingers zoom, a click selects. */
function pointing(v: Viewer) {
  const c = v.canvas;
  const pointers = new Map<number, { x: number; y: number }>();
  let travelled = 0;
  const zoomBy = (factor: number) => {
    v.state.zoom = Math.min(40, Math.max(1, v.state.zoom * factor));
    v.draw();
  };
  c.addEventListener("pointerdown", (e) => {
    pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
    travelled = 0;
    if (v.state.zoom > 1 || e.pointerType === "mouse") c.setPointerCapture(e.pointerId);
  });
  c.addEventListener("pointermove", (e) => {
    const before = pointers.get(e.pointerId);
    if (!before) return;
    const others = [...pointers].filter(([id]) => id !== e.pointerId).map(([, p]) => p);
    if (others.length === 1) {
      const [o] = others;
      zoomBy(Math.hypot(e.clientX - o.x, e.clientY - o.y) / Math.max(1, Math.hypot(before.x - o.x, before.y - o.y)));
    } else {
      travelled += Math.abs(e.clientX - before.x) + Math.abs(e.clientY - before.y);
      c.classList.add("panning");
      v.pan(e.clientX - before.x, e.clientY - before.y);
    }
    pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
  });
  const end = (e: PointerEvent) => {
    pointers.delete(e.pointerId);
    c.classList.remove("panning");
  };
  c.addEventListener("pointerup", end);
  c.addEventListener("pointercancel", end);
  c.addEventListener("click", (e) => {
    if (travelled > 4) return;
    const box = c.getBoundingClientRect();
    const [x, y] = [e.clientX - box.left, e.clientY - box.top];
    const hit = v.cells.find((cell) => x >= cell.left && x < cell.left + cell.width && y >= cell.top && y < cell.top + cell.height);
    if (hit) select(hit.test);
  });
  c.addEventListener(
    "wheel",
    (e) => {
      if (!e.ctrlKey && !e.metaKey && document.activeElement !== c) return;
      e.preventDefault();
      zoomBy(Math.exp(-e.deltaY * 0.002));
    },
    { passive: false },
  );
  c.addEventListener("keydown", (e) => {
    const step = 40;
    const act: Record<string, () => void> = {
      "+": () => zoomBy(1.3),
      "=": () => zoomBy(1.3),
      "-": () => zoomBy(1 / 1.3),
      ArrowLeft: () => v.pan(step, 0),
      ArrowRight: () => v.pan(-step, 0),
      ArrowUp: () => v.pan(0, step),
      ArrowDown: () => v.pan(0, -step),
      ",": () => moveTo(position - 0.01),
      ".": () => moveTo(position + 0.01),
    };
    if (!act[e.key]) return;
    e.preventDefault();
    act[e.key]();
  });
}

function specimens() {
  const canvas = h("canvas", { id: "view", tabindex: "0", role: "img", "aria-label": "Specimens. Plus and minus zoom, arrows pan, comma and full stop move through the test." });
  const overlay = h("div", { class: "cells" });
  const field = h("span", { class: "legend" });
  const place = h("div", { class: "viewer" }, canvas, overlay);
  const mode = choice(
    [["strain", `at equal ${report.axes.strain}`], ["part", "at equal part of each test"]],
    (value) => {
      equalStrain = value === "strain";
      update();
    },
    "mode",
  );
  slider.addEventListener("input", () => {
    position = Number(slider.value) / 1000;
    update();
  });
  const transport = h("div", { class: "controls" }, h("div", { class: "transport" }, playButton(), slider, readout), labelled("Specimens", mode));
  const which = report.calibration ? "The calibrated rock on one packing that the fit has not seen; above are means over several. " : "";
  const hint = h("p", { class: "muted" }, which, h("span", { class: "screen" }, "Slide through the test; a click on a specimen brings its curve forward. Drag to pan, Ctrl + wheel or + and − to zoom."));
  const target = section("specimens", "Specimens", hint);
  if (!report.tests.some((t) => t.scene)) {
    target.append(h("p", { class: "notice" }, "These results hold no displacement fields (test.n_frames), so the specimens cannot be drawn."));
    return;
  }
  target.append(legend(report.figures.modes.panels), place, transport);
  try {
    const shown = report.tests.map((t) => ({ ...t, load: t.scene ? () => readScene(document.getElementById(t.scene!)!.textContent!, report.axes.sign) : null }));
    viewer = new Viewer(canvas, shown, () => {
      feet.length = 0;
      labelSpecimens(viewer!, overlay, (i) => {
        const t = report.tests[i];
        feet[i] = h("span", { class: "screen" });
        return { head: t.theta === null ? t.label : `θ = ${t.label}`, color: t.color, foot: [...strengthOf(t).map((line, k) => h(k === 0 ? "strong" : "span", {}, line)), feet[i]] };
      });
      update();
    }, () => (document.querySelector("nav")?.offsetHeight ?? 0) + transport.offsetHeight + 24);
  } catch (error) {
    place.replaceWith(h("p", { class: "notice" }, `The specimens cannot be drawn: ${(error as Error).message}.`));
    return;
  }
  target.append(viewControls(viewer, field), field);
  pointing(viewer);
  new ResizeObserver(() => viewer!.layout()).observe(place);
}

// --- charts --------------------------------------------------------------------------------------------------

/** A dot on a chart that follows the slider. */
function cursor(place: HTMLElement, color: string): HTMLElement {
  const dot = h("i", { class: "cursor", style: `background:${color}` });
  place.append(dot);
  return dot;
}

function curves() {
  const { stress_strain: all, damage } = report.figures;
  const panel = all!.panels[0];
  const title = `${panel.y.quantity[0].toUpperCase()}${panel.y.quantity.slice(1)} and ${panel.x.quantity}`;
  const together = chart(title, h("span", { class: "screen" }, "Dots follow the slider."), (width, place) => {
    overview = draw(panel, width, { aspect: all!.aspect, selected });
    if (dots.length === 0) report.tests.forEach((t) => dots.push(cursor(place, t.color)));
    return overview.node;
  });
  const each = damage.panels.map((p, test) =>
    chart(p.title, null, (width, place) => {
      const drawn = draw(p, width, { aspect: damage.aspect });
      const known = multiples.find((m) => m.test === test);
      if (known) known.chart = drawn;
      else multiples.push({ chart: drawn, dot: cursor(place, "var(--ink)"), test });
      return drawn.node;
    }),
  );
  section("curves", "Curves", legend([panel], select), together, h("h3", {}, "Damage: stress (line, left) and cracks by kind (areas, right)"), legend(damage.panels), h("div", { class: "grid small" }, ...each));
}

function anisotropy() {
  const { anisotropy: over, modes } = report.figures;
  section(
    "anisotropy",
    "Anisotropy",
    legend(over.panels),
    h("div", { class: "grid four" }, ...over.panels.map((p) => panelChart(over, p)), chart("Failure mode: share of broken bonds and joints", legend(modes.panels), (width) => draw(modes.panels[0], width, modes).node)),
  );
}

function roses() {
  const { rose } = report.figures;
  section(
    "roses",
    "Directions of cracks",
    h("p", { class: "muted" }, "Directions of the broken bonds and joints of the whole test; the load acts along 90°. The area of a petal is proportional to the number of cracks; the dashed line is the bedding."),
    legend(rose.panels),
    grid(rose, "grid roses"),
  );
}

function events() {
  const { events: counted, event_places: places } = report.figures;
  if (counted.panels.length === 0) return;
  section(
    "events",
    "Acoustic events",
    h("p", { class: "muted" }, "Cracks near in time and space are one event. Its moment is the change of the contact forces around it. A circle grows with the magnitude of its event."),
    grid(counted),
    legend(places.panels),
    grid(places, "grid roses"),
  );
}

function openings() {
  const { opening } = report.figures;
  if (opening.panels.length === 0) return;
  section(
    "opening",
    "Opening",
    h("p", { class: "muted" }, "The hoop stress is a mean over a ring behind the wall. A breakout is rock that no bond holds on the rest; directions are from the horizontal, anticlockwise."),
    legend(opening.panels),
    grid(opening),
  );
}

// --- tables --------------------------------------------------------------------------------------------------

/** What the table on a terminal has, too: "<" and "*" as there. */
function cell(t: Test, c: Column): HTMLElement {
  const n = t.numbers[c.number];
  const known = n && n.value !== null;
  const bound = known && n.upper_bound ? "<" : "";
  const doubted = t.quality.marks.find((m) => m.of?.includes(c.number));
  const reservation = known && !bound && (doubted || (n.note && c.made_for)) ? "*" : "";
  const td = h("td", { "data-number": c.number, "data-specimen": t.name }, known ? bound + (n.value! * c.scale).toFixed(c.digits) + reservation : "–");
  if (n?.note || doubted) td.title = n?.note || doubted!.says;
  return td;
}

/** Not on paper. */
function onScreen<T extends HTMLElement | null>(made: T): T {
  made?.classList.add("screen");
  return made;
}

function numberTable(): HTMLElement {
  const used = report.columns.filter((c) => report.tests.some((t) => t.numbers[c.number]));
  const n = used.length;
  const rows: Child[][] = report.tests.map((t) => [t.label, ...used.map((c) => cell(t, c)), t.outcome.status, t.quality.grade]);
  const missing = report.missing.map((m): Child[] => [m.name, ...used.map(() => "–"), "missing", ""]);
  const made = table("Table of results", ["specimen", ...used.map((c) => h("span", {}, c.head, h("small", {}, c.unit))), "outcome", "quality"], [...rows, ...missing], null, [n + 1, n + 2]);
  made.querySelector("table")!.id = "numbers";
  const drawnElsewhere = used.flatMap((c, i) => (c.unit === "cracks" ? [i + 1] : [])); // over the strain, by kind
  for (const row of made.querySelectorAll("tr")) for (const i of drawnElsewhere) onScreen(row.cells[i]);
  return made;
}

/** Every number of result.json with all its digits. */
function everyNumber(): HTMLElement {
  const names = [...new Set(report.tests.flatMap((t) => Object.keys(t.numbers)))];
  const row = (name: string) => {
    const { unit, definition } = report.tests.find((t) => t.numbers[name])!.numbers[name];
    const values = report.tests.map((t) => t.numbers[name]?.value ?? null);
    const [factor, shown] = readable(Math.max(...values.map((v) => Math.abs(v ?? 0))), unit);
    return [name, shown, ...values.map((v) => (v === null ? "–" : Number.isInteger(v) && factor === 1 ? String(v) : String(+(v * factor).toPrecision(4)))), definition];
  };
  return onScreen(fold(`All ${names.length} numbers with their definitions`, table("All numbers", ["number", "unit", ...report.tests.map((t) => t.label), "definition"], names.map(row), null, [report.tests.length + 2])));
}

function tables() {
  section("tables", "Tables", h("p", { class: "muted" }, "“<”: an upper bound; “*”: with a reservation, “–”: could not be determined (the cell says why). All digits are in result.json of each specimen."), numberTable(), everyNumber());
}

// --- calibration ---------------------------------------------------------------------------------------------

function comparisonTable(rows: Comparison[], caption: string, yardsticks: Yardstick[] = []): HTMLElement | null {
  if (rows.length === 0) return null;
  const best = (r: Comparison) => yardsticks.find((y) => y.property === r.property)?.best;
  const rules: [string, (r: Comparison) => number | null | undefined][] = [];
  if (rows.some((r) => typeof r.with_discrepancy === "number")) rules.push(["with discrepancy", (r) => r.with_discrepancy]);
  if (yardsticks.some((y) => y.best)) rules.push(["best curve", (r) => r[best(r) as keyof Comparison] as number | null | undefined]);
  const within = (mean: number | null, sd: number | null, scale: number) => (mean === null ? "none" : (mean * scale).toFixed(0) + (sd === null ? "" : ` ± ${(sd * scale).toFixed(0)}`));
  const failure = ({ failure: f }: Comparison) => (f ? [within(f.bedding_share, f.bedding_share_sd, 100), `${within(f["angle [deg]"], f["angle_sd [deg]"], 1)} (${f.n_planes} of ${f.n_tests})`] : ["–", "–"]);
  const fails = rows.some((r) => r.failure);
  const heads = ["property", "θ [°]", "laboratory", "± sd", "n", "model", "± sd of packings", "rock, 95 %", "error", ...rules.map(([head]) => `error, ${head}`), ...(fails ? ["cracks along bedding [%]", "failure plane [°]"] : [])];
  return table(
    caption,
    heads,
    rows.map((r) => {
      const f = (v: number | null) => (v === null ? "–" : threeDigits(v * report.properties[r.property].factor));
      const { mean, sd, n } = r.laboratory;
      const error = (v: number | null | undefined) => (v == null ? "–" : r.property === "nu" ? signed(v - mean, 3) : `${signed(100 * (v / mean - 1), 1)}\u00a0%`);
      return [named(report.properties[r.property].axis, r), String(r["theta [deg]"]), f(mean), f(sd), String(n), f(r.model), f(r.sd_of_packings), r.low === null ? "–" : `${f(r.low)} … ${f(r.high)}`, error(r.model), ...rules.map(([, value]) => error(value(r))), ...(fails ? failure(r) : [])];
    }),
    caption,
  );
}

/** Where the interval of a parameter lies between the values that the calibration admits, in logarithms. */
function intervalBar(p: Estimate): Child {
  const [low, high] = p.box;
  if (!(low > 0 && high > low) || p.low === null || p.high === null || !(p.low > 0)) return "–";
  const at = (v: number) => Math.min(100, Math.max(0, (100 * Math.log(v / low)) / Math.log(high / low)));
  const bar = h("i", { style: `left:${at(p.low)}%;width:${Math.max(1.5, at(p.high) - at(p.low))}%` });
  return h("span", { class: "interval", role: "img", "aria-label": `${Math.round(at(p.low))} to ${Math.round(at(p.high))} % of the range` }, bar);
}

/** What a test has of its own: the size of its disc, its confining stress. Cells of one test at several angles share it. */
const particulars = (r: Comparison) => (r["diameter [m]"] ? `, ${(1e3 * r["diameter [m]"]).toPrecision(3)} mm` : "") + (r["confining [Pa]"] ? `, ${+(1e-6 * r["confining [Pa]"]).toPrecision(3)} MPa` : "");
const testOf = (r: Comparison) => r.property + particulars(r);

/** Laboratory and model, angles across. */
function angleTable(c: Calibration): HTMLElement {
  const rows = [...judged(c), ...alone(c)];
  const angles = [...new Set(rows.map((r) => r["theta [deg]"]))].sort((a, b) => a - b);
  const lines = [...new Set(rows.map(testOf))].flatMap((k): Child[][] => {
    const some = rows.filter((r) => testOf(r) === k);
    const { factor } = report.properties[some[0].property];
    const cells = (f: (r: Comparison) => string) => angles.map((a) => some.filter((r) => r["theta [deg]"] === a).map(f)[0] ?? "–");
    const interval = (r: Comparison) => c.fitted.find((f) => testOf(f) === testOf(r) && f["theta [deg]"] === r["theta [deg]"]) ?? r;
    const error = (r: Comparison) => (r.model === null ? "–" : r.property === "nu" ? signed(r.model - r.laboratory.mean, 2) : signed(100 * (r.model / r.laboratory.mean - 1), 1));
    return [
      [named(symbol(some[0].property), some[0]) + (alone(c).includes(some[0]) ? ", not fitted" : ""), ...cells((r) => threeDigits(r.laboratory.mean * factor))],
      [h("span", { class: "muted" }, "± SD (specimens)"), ...cells((r) => `${threeDigits(r.laboratory.sd * factor)} (${r.laboratory.n})`)],
      [h("span", { class: "muted" }, "model"), ...cells((r) => (r.model === null ? "–" : threeDigits(r.model * factor)))],
      [h("span", { class: "muted" }, some[0].property === "nu" ? "error" : "error, %"), ...cells(error)],
      ...(some.some((r) => interval(r).low !== null) ? [[h("span", { class: "muted" }, "rock, 95 %"), ...cells((r) => (interval(r).low === null ? "–" : `${threeDigits(interval(r).low! * factor)} – ${threeDigits(interval(r).high! * factor)}`))]] : []),
    ];
  });
  return table("Laboratory and model, angles across", ["θ [°]", ...angles.map(String)], lines, c.verification.length > 0 ? "Laboratory and model, on unseen packings" : "Laboratory and model, on the packings of the fit");
}

/** On unseen packings where there are, else on those of the fit. */
function judged(c: Calibration): Comparison[] {
  const same = (a: Comparison, b: Comparison) => testOf(a) === testOf(b) && a["theta [deg]"] === b["theta [deg]"];
  return c.fitted.map((f) => c.verification.find((v) => same(v, f)) ?? f);
}

/** What was compared alone: not fitted, without part in the verdict. */
const alone = (c: Calibration) => c.compared ?? [];

const signed = (v: number, digits: number) => `${v < 0 ? "−" : "+"}${Math.abs(v).toFixed(digits)}`;
/** Where there is little room. */
const symbol = (name: string) => (report.properties[name].axis.includes(" ") ? name : report.properties[name].axis);
/** With its unit and what the test has of its own. */
const named = (name: string, r: Comparison) => axisLabel({ quantity: name, unit: report.properties[r.property].unit }) + particulars(r);

/** Root mean squares, yardsticks below, and what it cost. */
function errorTable(c: Calibration): Child {
  if (!c.errors) return null;
  const properties = Object.keys(report.properties).filter((p) => c.errors!.some((e) => typeof e[p] === "number"));
  const cell = (v: number | string | undefined, p: string) => (typeof v !== "number" ? "–" : p === "nu" ? v.toFixed(3) : `${(100 * v).toFixed(1)}\u00a0%`);
  return table("Root mean square errors", ["root mean square error", ...properties.map(symbol)], c.errors.map((e) => [e.of, ...properties.map((p) => cell(e[p], p))]), "Errors, beside much simpler rules");
}

function cost(c: Calibration): Child {
  if (!c.runs) return null;
  const n = c.runs.of_these_in_tension;
  const has = (...names: string[]) => [...c.fitted, ...alone(c)].some((r) => names.includes(r.property));
  const shears = has("tau_peak");
  const kinds = [...(shears && !has("DTS", "BTS", "I_s50") ? [] : ["tension"]), ...(has("K_Ic") ? ["bending"] : []), ...(shears ? ["direct shear"] : [])];
  return h("p", { class: "muted" }, `${c.runs.strength_tests - n} tests in compression${n > 0 ? ` and ${n} in ${kinds.join(" or ")}` : ""}, ${c.runs.elastic_solutions} direct elastic solutions.`);
}

/** Parameters as the paper's Tables 1 and 2 have them. */
function parameterTables(c: Calibration): Child[] {
  return (c.tables ?? []).map((t) => table(t.head, [t.head, c.method === "sequence" ? "value" : "value [95 % interval]"], t.rows, t.title || null));
}

function whatIsDetermined(c: Calibration): HTMLElement {
  return table(
    "Parameters",
    ["parameter", "value", "95 % interval", "in the admitted range", "determined", "rests on, or next test"],
    c.parameters.map((p) => [h("span", { title: p.key }, p.symbol), friendly(p.value, p.unit), p.low === null ? "–" : `${friendly(p.low, p.unit)} … ${friendly(p.high, p.unit)}`, intervalBar(p), p.determined === null ? "–" : p.determined ? "yes" : "no", p.determined !== false ? (p.rests_on?.text ?? "") : p.next ? `next: ${p.next.text}` : "no test of a table determines it"]),
    null,
    [5],
  );
}

/** Eq. 2 on the packings of the fit, and with other planes. */
function eq2Table(lines: NonNullable<Calibration["eq2"]>): HTMLElement {
  const digits = (x: number | null, n: number, scale = 1) => (x === null ? "–" : (x * scale).toFixed(n));
  const cells = (l: Line) => [digits(l.ratio, 2), digits(l.slope, 2), digits(l.intercept, 0, 1e-9), digits(l.R2, 4)];
  const heads = (K: string, k: string) => [`${K}/${k}`, "slope", "intercept [GPa/m]", "R²"];
  return table("Eq. 2", ["planes", ...heads("K_n", "k_n"), ...heads("K_s", "k_s")], lines.map((l) => [l.planes, ...cells(l.K_n), ...cells(l.K_s)]), null);
}

function calibration() {
  const c = report.calibration;
  if (!c) return;
  const figure = report.figures.calibration!;
  const [status, ...rest] = c.verdict.sentence.split(/(?<=\.) /);
  const style = c.verdict.status === "calibrated" ? "notice verdict" : c.verdict.status.startsWith("calibrated") ? "notice verdict partly" : "notice";
  section(
    "calibration",
    "Verdict",
    h("div", { class: style }, h("strong", {}, status), rest.length > 0 && h("p", {}, rest.join(" ")), h("ul", { class: "findings" }, ...(c.verdict.lines ?? []).map((f) => h("li", {}, f)))),
    ...drawn(figure, false),
    h("p", { class: "muted on-paper" }, figure.panels.filter((p) => !p.aside && p.caption).map((p) => `${heading(p)}: ${p.caption}`).join(" ")),
  );
}

const drawn = (figure: Figure, aside: boolean) => {
  const panels = figure.panels.filter((p) => p.aside === aside);
  return panels.length > 0 ? [grid(figure, "grid small", panels), legend(panels)] : [];
};

/** The numbers behind the verdict. */
function values() {
  const c = report.calibration;
  if (!c) return;
  const figure = report.figures.calibration!;
  const aside = drawn(figure, true);
  section(
    "values",
    "Values",
    h("div", { class: "compact" }, h("div", {}, angleTable(c), errorTable(c), ...(c.yardsticks ?? []).map((y) => h("p", {}, y.text)), cost(c)), h("div", { class: "parameters" }, ...parameterTables(c))),
    fold("What the data determine", whatIsDetermined(c)),
    fold(`All findings (${c.verdict.findings.length}) and notes (${c.notes.length})`, h("div", { class: "remarks" }, ...c.verdict.findings.map((f) => h("p", {}, f.text)), ...c.notes.map((n) => h("p", { class: "muted screen" }, n.text)))),
    aside.length > 0 && fold(`More charts: ${figure.panels.filter((p) => p.aside).map((p) => p.y.quantity).join(", ")}`, ...aside),
    c.eq2 !== undefined &&
      fold(
        "Eq. 2: stiffness of the planes over stiffness of their joints, and how spacing and rule change it",
        h("p", { class: "muted" }, "K/k as calibrated, and the line K = slope · k + intercept through joints of half, once and twice the stiffness, on packings of the fit. E(θ) by direct solutions whose contacts also pull, K by Eq. 1 with E at 90°. The relation bends, the lower R² the more. Other packings have other lines too."),
        eq2Table(c.eq2),
      ),
    onScreen(
      fold(
        "Every cell",
        comparisonTable(c.fitted, "On the packings of the fit"),
        comparisonTable(c.verification, "On packings that the fit has not seen"),
        comparisonTable(c.tangent_from_test ?? [], "E and ν at 40 – 60 % of UCS: those on unseen packings with what tests there make of them; above: at small strain"),
        comparisonTable(c.left_out, "Each value predicted without it", c.yardsticks),
      ),
    ),
  );
}

// --- design --------------------------------------------------------------------------------------------------

/** One sheet: charts, constants, what to keep in mind. */
function design() {
  const d = report.design;
  if (!d) return;
  section(
    "design",
    "Constants for other codes",
    ...drawn(d.figure, false),
    // Where a row is a constant, its meaning is the last of four cells.
    h("div", { class: "compact" }, ...d.tables.map((t) => table(t.title, t.head, t.rows, t.title, t.head.length === 4 ? [3] : []))),
    h("div", { class: "remarks" }, ...d.findings.map((f) => h("p", {}, f.text))),
  );
}

// --- studies -------------------------------------------------------------------------------------------------

/** Means as they are drawn, the places across. */
function meansTable(key: string, panels: Panel[]): HTMLElement {
  const means = (p: Panel) => p.series.filter((s) => s.name && s.mark === "points");
  const columns = panels.flatMap((p) => [...new Set(means(p).flatMap((s) => s.x))].sort((a, b) => a - b).map((at) => ({ p, at })));
  const names = [...new Set(panels.flatMap(means).map((s) => s.name))];
  const cell = (name: string, { p, at }: (typeof columns)[number]) => {
    const s = means(p).find((s) => s.name === name);
    const i = s ? s.x.indexOf(at) : -1;
    return i < 0 ? "–" : [s!.y[i]!.toFixed(2), s!.text[i]].filter(Boolean).join(" ");
  };
  return table(key, [panels[0]?.title ?? key, ...columns.map(({ p, at }) => `${axisLabel(p.y)} ${at}${p.x.unit}`)], names.map((name) => [name, ...columns.map((c) => cell(name, c))]));
}

/** effects.csv as it stands, numbers shortened. */
function effects() {
  if (report.effects.length < 2) return;
  const short = (cell: string) => (cell.length > 8 && Number.isFinite(Number(cell)) ? Number(cell).toPrecision(5) : cell);
  const [head, ...rows] = report.effects;
  section("effects", "Effects", h("details", {}, h("summary", {}, `${rows.length} effects of the parameters`), table("Effects", head, rows.map((r) => r.map(short)))));
}

function studies() {
  const study = report.figures.study;
  if (!study) return;
  const { macro, parameters } = study;
  section(
    "study-0",
    "What the parameters do",
    h("p", { class: "muted" }, "One parameter varies, the others stay at their base (thick). Bars are 95 % intervals over packings and bond seeds, where there are three or more; of two, both values are small points. Lines: Eq. 1 fitted, or guides through the values."),
    ...(macro.panels.length > 0 ? [legend(macro.panels), grid(macro, "grid")] : []),
    ...parameters.flatMap(({ key, figure }): Child[] => [h("h3", {}, key), legend(figure.panels), grid(figure, "grid"), fold("Numbers", meansTable(key, figure.panels))]),
  );
}

// --- text ----------------------------------------------------------------------------------------------------

function texts() {
  if (report.methods.length > 0) section("methods", "Methods", ...report.methods.map((p) => h("p", {}, p)), copyButton(report.methods.join("\n\n")));
  if (report.recipe) onScreen(section("recipe", "Recipe", h("p", { class: "muted" }, "The completed recipe: every key with its value. Running it again gives the same bits."), h("pre", { tabindex: "0" }, report.recipe), copyButton(report.recipe)));
  const hashes = report.tests.map((t) => `${t.label} ${t.result.result_hash}`).join(", ");
  document.getElementById("footer")!.append(h("p", {}, `${report.program}.${hashes ? ` Fingerprints of the results: ${hashes}.` : ""}`));
}

// --- start ---------------------------------------------------------------------------------------------------

/** Everything at the width that it has now; on paper the specimens are as sharp as a printer. */
function layOut(paper: boolean) {
  redraw(true);
  document.querySelector(".snapshot")?.remove();
  if (!viewer) return;
  viewer.paper = paper;
  viewer.readColors();
  viewer.layout();
  viewer.drawNow();
  if (paper) snapshot(viewer.canvas);
}

/** A canvas of WebGL with a new size is blank on paper until its next frame: a copy is not. */
function snapshot(canvas: HTMLCanvasElement) {
  const copy = h("canvas", { class: "snapshot", width: String(canvas.width), height: String(canvas.height) });
  copy.getContext("2d")!.drawImage(canvas, 0, 0);
  canvas.after(copy);
}

/** Who, what for, from which files, when: what nobody has said is left out. */
function cover() {
  const lines = [...report.head, ["program", report.program]].flatMap(([name, text]) => (text ? [h("div", {}, h("dt", {}, name), h("dd", {}, text))] : []));
  document.getElementById("subtitle")!.after(h("dl", { class: "cover" }, ...lines));
  const of = report.head.find(([name]) => name === "written");
  paperFoot([report.name, report.head.find(([name]) => name === "project")?.[1], of?.[1], report.program].filter(Boolean).join(" · "));
}

/** What was tested: of one rock there are many reports. */
function done(): string {
  if (report.calibration || report.tests.length === 0) return "";
  const { kind, kept, stress } = report.done;
  const words = (name: string) => name.replaceAll("_", " ");
  const angles = report.tests.filter((t) => t.theta !== null).map((t) => t.label);
  const some = angles.length > 3 ? `${angles[0]} … ${angles[angles.length - 1]}` : angles.join(", ");
  const specimens = [some && `θ = ${some}`, report.tests.some((t) => t.theta === null) && "intact"].filter(Boolean).join(", ");
  return [words(kind), kept && `${words(kept)} ${+(1e-6 * stress).toPrecision(4)} MPa`, specimens].filter(Boolean).join(", ");
}

function start() {
  document.title = [report.name, done(), "Phyllite report"].filter(Boolean).join(" – ");
  document.getElementById("title")!.textContent = report.name;
  document.getElementById("test")!.textContent = done();
  const n = report.tests.length;
  const peaked = report.tests.filter((t) => t.outcome.status === "peaked").length;
  const about = report.calibration ? "calibration" : report.figures.study ? "study" : report.design ? "design" : `${n} specimen${n === 1 ? "" : "s"}, ${peaked} to the peak`;
  document.getElementById("subtitle")!.textContent = about;
  cover();
  theme(() => {
    viewer?.readColors();
    viewer?.draw();
  });
  main.append(...notices().filter((x): x is HTMLElement => x instanceof HTMLElement));
  calibration();
  design();
  studies();
  effects();
  if (n > 0) {
    specimens();
    values();
    curves();
    if (!report.calibration) anisotropy(); // of a calibration: above, over all packings
    roses();
    events();
    openings();
    tables();
  } else values();
  texts();
  reservations();
  redraw(false, charts.slice(0, 1));
  update();
  viewer?.layout();
  performance.mark("interactive");
  const drawn = drawRest()
    .then(() => viewer?.load())
    .then(() => {
      document.documentElement.dataset.ready = "true";
      viewer?.layout();
    });
  const print = printing(drawn, layOut);
  document.getElementById("actions")!.prepend(saver("Print or PDF", "Print or PDF", print), saver("Tables .xlsx", "Tables .xlsx", () => saveFile(report.name, "xlsx", allTables())));
  // For tests: the script time of the last frames.
  (window as unknown as { phyllite: unknown }).phyllite = { viewer, moveTo, report };
}

start();

// The specimen from the first minute. Its bedding is turned by hand; what the rock is at that angle travels along the charts.
import { Scene, f32, noCracks } from "../data";
import { h } from "../dom";
import { Panel, Series, series } from "../figure";
import { Viewer } from "../viewer";
import { attempt, button, input, keyed, objections } from "./controls";
import { redrawOnTheme } from "./live";
import { Checked, Files, RockAnswer, ask } from "./server";
import { get } from "./toml";

interface Discs {
  width: number;
  height: number;
  discs: string;
  bedding: { theta: number; spacing: number; offset: number } | null;
}

interface Moduli {
  theta: number;
  E: number | null;
  nu: number | null;
}

/** Around the specimen. */
export interface Hands {
  turned: () => void; // the charts are to be drawn anew
  changed: () => void; // a test has been started
}

export interface GrabView {
  node: HTMLElement;
  show(answer: RockAnswer, text: Files): void;
  mark(checked: Checked, text: Files): void;
  /** A panel of the check with what is known at the angle. */
  marked(panel: Panel): Panel;
}

const tallest = 300; // of the specimen [CSS pixels]
const settled = 250; // after the last move, before anything is computed [ms]

const isOf = (panel: Panel, quantity: string) => panel.y.quantity === quantity && panel.title === "";
/** From SI to the unit of the axis. */
const scale = (panel: Panel) => ({ GPa: 1e-9, MPa: 1e-6 })[panel.y.unit] ?? 1;

/** Straight between the points of a curve; null: it does not go so far. */
function along(curve: Series | undefined, x: number): number | null {
  const i = curve ? curve.x.findIndex((at, k) => k > 0 && at >= x && curve.x[k - 1] <= x) : -1;
  if (!curve || i < 1) return null;
  const [a, b] = [curve.y[i - 1], curve.y[i]];
  if (a === null || b === null) return null;
  return a + ((x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1] || 1)) * (b - a);
}

/** A canvas with one specimen that has not been loaded. */
class Standing {
  readonly canvas = h("canvas", { role: "img", "aria-label": "Specimen with its bedding" });
  private viewer: Viewer | null = null;
  private scene: Scene | null = null;
  private bedding: Discs["bedding"] = null;

  constructor() {
    new ResizeObserver(() => this.viewer?.layout()).observe(this.canvas);
    redrawOnTheme(() => {
      this.viewer?.readColors();
      this.viewer?.draw();
    });
  }

  put(d: Discs, theta: number) {
    const discs = f32(d.discs);
    this.bedding = d.bedding;
    this.scene = { width: d.width, height: d.height, discs, quantum: 1, strains: [0], frames: [new Int16Array((2 * discs.length) / 3)], jointed: new Uint8Array(discs.length / 3), links: new Uint32Array(0), forceStrains: [], forceMax: [], forces: new Int8Array(0) };
    this.viewer ??= new Viewer(this.canvas, [{ cracks: noCracks(), bedding: [], end: 0, load: null }], () => {}, () => innerHeight - tallest, [4, 4], true);
    this.turn(theta);
    this.viewer.layout();
  }

  turn(theta: number) {
    if (!this.viewer || !this.scene) return;
    Object.assign(this.viewer.tests[0], { bedding: this.bedding ? [{ ...this.bedding, theta }] : [] });
    this.viewer.put(0, this.scene);
    this.viewer.draw();
  }
}

export function grabView(rock: string, hands: Hands): GrabView {
  const standing = new Standing();
  const wrong = objections();
  const known = new Map<number, Moduli>();
  let theta = 45;
  let panels: Panel[] = [];
  let drawn = ""; // the specimen that stands there
  let model = ""; // the calibration that has been asked
  let calibration = "";
  let taken: string[] = [];
  let timer = 0;
  let text: Files = { table: null, toml: "" };

  const angle = input((v) => turn(Number(v)), { type: "range", min: "0", max: "90", step: "1", id: "bedding-angle" });
  const readings = h("dl", { class: "readings" });
  const note = h("p", { class: "muted" });
  const press = button("Press it", () => void attempt(wrong, pressIt), { class: "main" });
  const node = h("div", { class: "grab" }, h("div", { class: "standing" }, standing.canvas), h("div", {}, h("label", { for: "bedding-angle" }, "Bedding angle: drag it, or the planes"), angle, readings, h("div", { class: "tools" }, press), note, wrong));
  node.hidden = true;

  function turn(to: number) {
    theta = Math.min(90, Math.max(0, Math.round(to)));
    angle.value = String(theta);
    angle.setAttribute("aria-valuetext", `${theta} degrees`);
    standing.turn(theta);
    say();
    hands.turned();
    clearTimeout(timer);
    if (model && !known.has(theta)) timer = window.setTimeout(() => void attempt(wrong, solve), settled);
  }

  async function solve() {
    const [of, at] = [model, theta];
    const moduli = await ask<Moduli>("/api/moduli", { name: rock, calibration, theta: at });
    if (of !== model) return;
    known.set(at, moduli);
    say();
    hands.turned();
  }

  const panelOf = (quantity: string) => panels.find((p) => isOf(p, quantity));
  /** By the closed form fitted to the table, where one fits. */
  const byTheory = (panel: Panel | undefined) => along(panel?.series.find((s) => s.role === "theory" && s.mark === "line"), theta);

  function say() {
    const line = (name: string, value: string, by: string) => [h("dt", {}, name), h("dd", {}, value, h("small", {}, by))];
    const m = known.get(theta);
    const ucs = byTheory(panelOf("UCS")), E = byTheory(panelOf("E"));
    readings.replaceChildren(
      ...line("θ", `${theta}°`, ""),
      ...(m?.E != null ? line("E", `${(1e-9 * m.E).toPrecision(3)} GPa`, "direct solution, small strain") : E !== null ? line("E", `${E.toPrecision(3)} GPa`, "Goodman, fitted to the table") : []),
      ...(m?.nu != null ? line("ν", m.nu.toPrecision(3), "direct solution, small strain") : []),
      ...(ucs !== null ? line("UCS", `${ucs.toPrecision(3)} MPa`, "Jaeger, fitted to the table") : []),
    );
  }

  /** UCS of the calibrated rock at this angle. */
  async function pressIt() {
    const test = `press-${theta}-deg`;
    if (!taken.includes(test)) {
      const changes = { "test.kind": "uniaxial", "test.angles": `["${theta} deg"]`, "test.intact": "false" };
      const recipe = await ask<{ toml: string | null; problems: { text: string }[] }>("/api/recipe", { name: rock, calibration, changes });
      if (recipe.toml === null) throw new Error(recipe.problems.map((p) => p.text).join("; "));
      await ask("/api/test", { name: rock, test, toml: recipe.toml });
      hands.changed();
    }
    document.getElementById("tests")?.scrollIntoView();
  }

  /** The planes follow the hand. */
  function grab(e: PointerEvent) {
    if (e.buttons === 0 && e.type !== "pointerdown") return;
    const box = standing.canvas.getBoundingClientRect();
    const [x, y] = [Math.abs(e.clientX - box.left - box.width / 2), Math.abs(e.clientY - box.top - box.height / 2)];
    if (x + y > 4) turn((Math.atan2(y, x) * 180) / Math.PI);
  }
  standing.canvas.addEventListener("pointerdown", (e) => {
    standing.canvas.setPointerCapture(e.pointerId);
    grab(e);
  });
  standing.canvas.addEventListener("pointermove", grab);

  async function stand() {
    const d = await ask<Discs>("/api/discs", { name: rock, ...text });
    node.hidden = false;
    angle.disabled = d.bedding === null;
    standing.put(d, theta);
    turn(theta);
  }

  return {
    node,
    show(answer, now) {
      text = now;
      taken = answer.tests.map((t) => t.name);
      const tested = answer.calibrations.find((b) => b.folder === answer.calibration.folder && b.tested) ?? answer.calibrations.find((b) => b.tested);
      calibration = tested?.folder ?? "";
      const next = tested ? JSON.stringify([tested.folder, tested.errors]) : "";
      press.disabled = tested === undefined;
      keyed(note, press.disabled, () => [press.disabled ? "Pressing it needs a calibrated rock; E and ν follow the angle then, too." : "One specimen of the calibrated rock, until it breaks."]);
      if (next === model) return;
      model = next;
      known.clear();
      if (model && !node.hidden) turn(theta);
    },
    mark(checked, now) {
      text = now;
      panels = checked.figure?.panels ?? [];
      if (checked.problems.length > 0) return;
      const of = JSON.stringify([checked.grains, ...[["specimen", "width"], ["specimen", "height"], ["bedding", "spacing"], ["", "recipe"], ["", "bedded"]].map(([t, k]) => get(now.toml, t, k))]);
      say();
      if (of === drawn) return;
      drawn = of;
      void attempt(wrong, stand);
    },
    marked(panel) {
      const quantity = ["E", "UCS", "ν"].find((q) => isOf(panel, q));
      if (node.hidden || !quantity) return panel;
      const computed = [...known.values()].filter((m) => (quantity === "E" ? m.E : quantity === "ν" ? m.nu : null) !== null);
      const value = (m: Moduli) => (quantity === "E" ? m.E! : m.nu!) * scale(panel);
      const here = byTheory(panel);
      return {
        ...panel,
        series: [
          series("line", "others", { x: [theta, theta], y: [panel.y.low, panel.y.high] }),
          ...panel.series,
          ...(here !== null ? [series("points", "theory", { x: [theta], y: [here] })] : []),
          ...(quantity !== "UCS" && computed.length > 0 ? [series("points", "model", { name: "direct solution", x: computed.map((m) => m.theta), y: computed.map(value) })] : []),
        ],
      };
    },
  };
}

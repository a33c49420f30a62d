// Draws figures as the program describes them (src/report/figure.hpp) with Observable Plot: SVG that scales, follows light and dark
// through CSS colours, and prints as vectors. Knows series and axes, and nothing of rock.
import * as Plot from "@observablehq/plot";
import { h } from "./dom";

export interface Axis {
  quantity: string;
  unit: string;
  low: number;
  high: number;
  step: number; // between ticks; 0: as there is room
  logarithmic: boolean;
  names: string[]; // of 0, 1, 2, ... in place of numbers
}

export interface Series {
  name: string; // in the legend; empty: not there
  mark: "line" | "points" | "dots" | "text" | "band" | "boxes" | "area";
  role: string;
  number: number;
  shade: number | null; // 0 … 1
  strong: boolean;
  right: boolean;
  width: number; // of boxes
  item: number; // the specimen that it is of; -1: of none alone
  x: number[];
  y: (number | null)[]; // this and what follows: empty where no point has one
  low: (number | null)[];
  high: (number | null)[];
  text: string[];
}

export interface Panel {
  title: string;
  caption: string;
  x: Axis;
  y: Axis;
  right: Axis | null;
  series: Series[];
  framed: boolean;
  aside: boolean; // for a second look
}

export interface Figure {
  panels: Panel[];
  key: "none" | "shared" | "inside";
  aspect: number;
}

/** An axis and a series with no more than what is said of them. */
export const axis = (quantity: string, unit: string, low: number, high: number, more: Partial<Axis> = {}): Axis => ({ quantity, unit, low, high, step: 0, logarithmic: false, names: [], ...more });
export const series = (mark: Series["mark"], role: string, some: { x: number[] } & Partial<Series>): Series => ({ name: "", mark, role, number: 0, shade: null, strong: false, right: false, width: 0, item: -1, y: [], low: [], high: [], text: [], ...some });

export const axisLabel = (a: { quantity: string; unit: string }) => (a.unit ? `${a.quantity} [${a.unit}]` : a.quantity);

// --- looks ---------------------------------------------------------------------------------------------------

const ordered = ["#4f6bd8", "#2b93cf", "#12a594", "#5aa343", "#b0920f", "#e0762a", "#d1466f"];
const inks: Record<string, string> = { model: "var(--accent)", bare: "var(--accent)", interval: "var(--accent)", between: "var(--muted)", theory: "var(--theory)", left_out: "var(--pull)", intact: "var(--intact)", others: "var(--muted)", frame: "var(--line)" };
const dashes: Record<string, string> = { theory: "7 4", bare: "4 3", others: "7 4", bedding: "5 3" };
const symbols = ["circle", "square", "triangle", "diamond", "star", "wye", "cross"] as const;
const signs: Record<string, string> = { circle: "●", square: "■", triangle: "▲", diamond: "◆", star: "★", wye: "Y", cross: "✚", times: "×" };

export function colorOf(s: Series): string {
  if (s.role === "ordered" || (s.role === "level" && s.shade !== null)) return ordered[Math.round(6 * (s.shade ?? 0.5))];
  if (s.role === "listed") return `var(--line-${s.number % 6})`;
  if (s.role === "crack") return `var(--crack-${s.number % 4})`;
  return inks[s.role] ?? "var(--ink)";
}

function symbolOf(s: Series) {
  if (s.role === "level") return (["triangle", "square", "star"] as const)[s.number % 3];
  if (s.role === "left_out") return "times";
  if (s.role === "laboratory") return "diamond";
  return s.role === "ordered" || s.role === "listed" ? symbols[s.number % symbols.length] : "circle";
}

// --- marks ---------------------------------------------------------------------------------------------------

interface Dot {
  x: number;
  y: number | null;
  low: number | null;
  high: number | null;
  text: string;
  s: Series;
}

/** `scale`: from the axis on the right to that on the left. */
const dotsOf = (s: Series, scale = 1): Dot[] => {
  const at = (values: (number | null)[], i: number) => (values[i] == null ? null : values[i]! * scale);
  return s.x.map((x, i) => ({ x, y: at(s.y, i), low: at(s.low, i), high: at(s.high, i), text: s.text[i] ?? "", s }));
};

function marksOf(s: Series, dots: Dot[], faded: boolean): Plot.Markish[] {
  const [color, xy] = [colorOf(s), { x: "x", y: "y" }];
  const surface = "var(--surface)";
  switch (s.mark) {
    case "line":
      return [Plot.line(dots, { ...xy, stroke: color, strokeWidth: s.strong ? 2.8 : 1.7, strokeOpacity: faded ? 0.22 : 1, strokeDasharray: dashes[s.role] })];
    case "points": {
      const [symbol, bars] = [symbolOf(s), dots.filter((d) => d.high !== null)];
      const hollow = symbol === "times" ? { stroke: color, strokeWidth: 1.8 } : s.role === "laboratory" ? { stroke: color, fill: surface, strokeWidth: 1.6 } : { fill: color, stroke: surface, strokeWidth: 1 };
      return faded ? [] : [Plot.ruleX(bars, { x: "x", y1: "low", y2: "high", stroke: color, strokeWidth: 1.4 }), Plot.dot(dots, { ...xy, symbol, r: s.role === "laboratory" ? 5.5 : s.role === "model" ? 3.8 : 4.5, ...hollow })];
    }
    case "dots":
      return [Plot.dot(dots, { ...xy, r: 2.2, fill: color, fillOpacity: 0.6 })];
    case "text":
      return faded ? [] : [Plot.text(dots, { ...xy, text: "text", dy: -13, fill: color === "var(--line)" ? "var(--muted)" : color, fontWeight: 600, stroke: surface, strokeWidth: 4 })];
    case "band":
      return [Plot.areaY(dots, { x: "x", y1: "low", y2: "high", fill: color, fillOpacity: s.role === "between" ? 0.16 : 0.55 })];
    case "boxes":
      return [Plot.rect(dots, { x1: (d: Dot) => d.x - s.width / 2, x2: (d: Dot) => d.x + s.width / 2, y1: "low", y2: "high", fill: color, fillOpacity: s.role === "interval" ? 0.22 : 1 })];
    case "area":
      return [Plot.line(dots, { ...xy, curve: "linear-closed", fill: color, stroke: "none" })];
  }
}

/** What is said of a point: of all series that have one at the same place. */
function said(d: Dot, all: Dot[], panel: Panel): string {
  const unit = panel.y.unit && ` ${panel.y.unit}`;
  const one = ({ y, low, high, text, s }: Dot) => {
    const range = low !== null && high !== null && (s.mark !== "boxes" || !text) && `${low.toPrecision(3)} … ${high.toPrecision(3)}${y === null ? unit : ""}`;
    return `${s.name}: ${[y !== null && y.toPrecision(4) + unit, range, text].filter(Boolean).join(", ")}`;
  };
  const place = panel.x.names.length > 0 ? panel.x.names[d.x] : `${+d.x.toPrecision(4)}${panel.x.unit === "°" ? "" : " "}${panel.x.unit}`;
  return [`at ${place}`, ...all.filter((other) => other.x === d.x).map(one)].join("\n");
}

// --- panels --------------------------------------------------------------------------------------------------

/** A drawn panel, with the way from values to pixels. */
export interface Drawn {
  node: SVGSVGElement | HTMLElement;
  x: (v: number) => number;
  y: (v: number) => number;
}

export interface View {
  aspect?: number; // of the figure
  selected?: number | null; // all of other specimens steps back
  bare?: boolean; // what is measured upwards is said elsewhere
}

const every = (a: Axis, step: number) => Array.from({ length: Math.floor((a.high - a.low) / step) + 1 }, (_, i) => (Math.ceil(a.low / step) + i) * step).filter((t) => t <= a.high);

/** 1, 2, 5 of each power of ten; where these are many, powers alone. */
function logTicks({ low, high }: Axis): number[] {
  const powers = Array.from({ length: 40 }, (_, i) => 10 ** (i - 20)).filter((p) => p <= high && 10 * p >= low);
  return (powers.length > 3 ? [1] : [1, 2, 5]).flatMap((k) => powers.map((p) => k * p)).filter((t) => t >= low && t <= high);
}

const shortNumber = (v: number) => (v >= 1e5 || (v > 0 && v < 1e-3) ? v.toExponential(0).replace("e+", "e") : String(+v.toPrecision(2)));

/** `room` for ticks [px], `apart` from one to the next. */
function scaleOf(a: Axis, room: number, apart: number) {
  const ticks = a.names.length > 0 ? a.names.map((_, i) => i) : a.step > 0 ? every(a, a.step * (room < 280 ? 2 : 1)) : a.logarithmic ? logTicks(a) : Math.max(3, room / apart);
  return { domain: [a.low, a.high], type: a.logarithmic ? "log" : "linear", ticks, ...(a.names.length > 0 && { tickFormat: (i: number) => a.names[i] ?? "" }), ...(a.logarithmic && { tickFormat: shortNumber }) } as const;
}

function axesOf(panel: Panel, width: number, height: number, bare: boolean): Plot.PlotOptions {
  const label = { labelAnchor: "center", labelArrow: "none" } as const;
  return {
    marginLeft: 50,
    marginRight: panel.right ? 44 : 16,
    marginTop: bare ? 12 : 28,
    marginBottom: 40,
    grid: true,
    x: { label: axisLabel(panel.x), ...label, ...scaleOf(panel.x, width, 110) },
    y: { label: bare ? null : axisLabel(panel.y), labelArrow: "none", ...scaleOf(panel.y, height, 50) },
  };
}

/** The axis on the right: its numbers at their heights on the left one. */
function rightAxis(panel: Panel, scale: number): Plot.Markish[] {
  const ticks = [0, 0.25, 0.5, 0.75, 1].map((part) => Math.round(part * panel.right!.high));
  const numbers = [...new Set(ticks)].map((v) => v * scale);
  return [Plot.axisY(numbers, { anchor: "right", label: axisLabel(panel.right!), labelArrow: "none", tickFormat: (v: number) => Math.round(v / scale).toString() }), Plot.axisY({ anchor: "left", label: axisLabel(panel.y), labelArrow: "none" })];
}

export function draw(panel: Panel, width: number, view: View = {}): Drawn {
  const scale = panel.right ? panel.y.high / panel.right.high : 1;
  const dots = panel.series.map((s) => dotsOf(s, s.right ? scale : 1));
  const faded = (s: Series) => view.selected != null && s.item >= 0 && s.item !== view.selected;
  const pointed = dots.flat().filter((d) => d.s.name && !d.s.right && !["area", "text", "band"].includes(d.s.mark) && !faded(d.s));
  const height = panel.framed ? Math.max(165, Math.min(460, 0.78 * (view.aspect ?? 0.85) * width)) : width;
  const node = Plot.plot({
    style: { background: "none", fontFamily: "inherit", fontSize: "var(--chart-text, 12px)", overflow: "visible" },
    width,
    height,
    ...(panel.framed ? axesOf(panel, width, height, view.bare ?? false) : { axis: null, margin: 0, x: { domain: [panel.x.low, panel.x.high] }, y: { domain: [panel.y.low, panel.y.high] } }),
    marks: [
      panel.framed && !panel.y.logarithmic ? Plot.ruleY([0]) : [],
      panel.right ? rightAxis(panel, scale) : [],
      ...panel.series.map((s, i) => marksOf(s, dots[i], faded(s))),
      panel.framed ? Plot.tip(pointed, Plot.pointer({ x: "x", y: (d: Dot) => d.y ?? (d.low! + d.high!) / 2, title: (d: Dot) => said(d, pointed, panel), fill: "var(--surface)", lineWidth: 40 })) : [],
    ],
  });
  const [x, y] = [node.scale("x")!, node.scale("y")!];
  return { node: node as SVGSVGElement, x: (v) => x.apply(v), y: (v) => y.apply(v) };
}

/** One sign for each name; where `choose` is given, the lines of specimens are buttons. */
export function legend(panels: Panel[], choose?: (item: number) => void): HTMLElement {
  const all = panels.flatMap((p) => p.series.filter((s) => s.name));
  const named = all.filter((s, i) => all.findIndex((other) => other.name === s.name) === i);
  const sign = (s: Series) => {
    if (s.mark === "line") return h("i", { class: dashes[s.role] ? "line" : "line solid", style: `border-color:${colorOf(s)}` });
    if (s.mark === "points" || s.mark === "dots") return h("span", { style: `color:${s.role === "level" ? "var(--ink)" : colorOf(s)}`, "aria-hidden": "true" }, s.mark === "dots" ? "•" : s.role === "laboratory" ? "◇" : signs[symbolOf(s)]);
    const share = s.role === "interval" ? 25 : s.role === "between" ? 16 : 100;
    return h("i", { style: `background:color-mix(in srgb, ${colorOf(s)} ${share}%, var(--surface))` });
  };
  const entry = (s: Series) => {
    if (!choose || s.item < 0 || s.mark !== "line") return h("li", {}, sign(s), s.name);
    const button = h("button", { type: "button", "data-test": String(s.item), "aria-pressed": "false" }, sign(s), s.name);
    button.addEventListener("click", () => choose(s.item));
    return h("li", {}, button);
  };
  return h("ul", { class: "legend" }, ...named.map(entry));
}

// Charts as SVG (Observable Plot): they scale, follow light and dark through CSS colours, and print as vectors.
import * as Plot from "@observablehq/plot";
import { Axes, Comparison, Curve, LabPoint, Report, Spread, Test, crackKinds, lastUpTo } from "./data";
import { unitOf } from "./units";

export const base = {
  style: { background: "none", fontFamily: "inherit", fontSize: "12px", overflow: "visible" },
  grid: true,
};

/** A chart that shares its row with others. */
export const panel = (width: number, marginLeft = 46) => ({ ...base, width, height: Math.max(220, width * 0.66), marginLeft, marginTop: 28, marginBottom: 40 });

export const inclination = { label: "inclination of bedding θ [°]", labelAnchor: "center", labelArrow: "none" } as const;

/** Ticks every 15 degrees, or 30 where it is narrow. */
export const angles = (far: number, width: number) => {
  const step = width < 280 ? 30 : 15;
  return Array.from({ length: Math.floor(far / step) + 1 }, (_, i) => i * step);
};

/** A value of a chart in words. */
const inWords = (v: number, label: string) => `${v.toPrecision(4)} ${unitOf(label)}`.trim();

/** What a model misses the laboratory by: of a ratio the difference, else a share. */
const missedBy = (model: number, mean: number, isRatio: boolean) => `error ${model < mean ? "−" : "+"}${isRatio ? Math.abs(model - mean).toFixed(3) : `${Math.abs(100 * (model / mean - 1)).toFixed(1)} %`}`;

const value = (t: Test, name: string): number | null => t.numbers[name]?.value ?? null;

/** Stress in MPa over strain in the unit of the axes; long histories are thinned to what a chart can show. */
function curvePoints(t: Test, axes: Axes) {
  const step = Math.max(1, Math.floor(t.strain.length / 900));
  const points: { strain: number; stress: number; name: string }[] = [];
  let top = 0;
  for (let i = 0; i < t.stress.length; ++i) if (t.stress[i] > t.stress[top]) top = i;
  for (let i = 0; i < t.strain.length; ++i)
    if (i % step === 0 || i === top || i === t.strain.length - 1)
      points.push({ strain: axes.strain_factor * t.strain[i], stress: 1e-6 * t.stress[i], name: t.name });
  return points;
}

/** Strain at which the loading branch first reaches a stress. */
function strainAt(t: Test, stress: number | null): number | null {
  if (stress === null) return null;
  for (let i = 0; i < t.stress.length; ++i) if (t.stress[i] >= stress) return t.strain[i];
  return null;
}

/** Damage stresses and strength where the curve first reaches them. */
function marks(t: Test, axes: Axes) {
  const levels = [
    { name: "sigma_ci", label: "σci", symbol: "triangle" as const },
    { name: "sigma_cd", label: "σcd", symbol: "square" as const },
    { name: axes.strength, label: peakLabel(axes), symbol: "star" as const },
  ];
  return levels.flatMap((l) => {
    const stress = value(t, l.name);
    const strain = strainAt(t, stress);
    return stress === null || strain === null
      ? []
      : [{ strain: axes.strain_factor * strain, stress: 1e-6 * stress, symbol: l.symbol, label: l.label, peak: l.name === axes.strength, test: t }];
  });
}

export const peakLabel = (axes: Axes) => (axes.strength_label.length > 5 ? "peak" : axes.strength_label);

export interface LinkedChart {
  node: SVGSVGElement | HTMLElement;
  x: (strain: number) => number; // strain in the unit of the axes to pixels
  y: (stress: number) => number;
}

function linked(node: ReturnType<typeof Plot.plot>): LinkedChart {
  const [x, y] = [node.scale("x")!, node.scale("y")!];
  return { node: node as SVGSVGElement, x: (v) => x.apply(v), y: (v) => y.apply(v) };
}

/** All stress-strain curves with damage stresses marked. */
export function stressStrain(report: Report, width: number, selected: number | null): LinkedChart {
  const points = report.tests.flatMap((t, i) =>
    curvePoints(t, report.axes).map((p) => ({ ...p, color: t.color, fade: selected !== null && selected !== i })),
  );
  const all = report.tests.flatMap((t, i) => (selected === null || selected === i ? marks(t, report.axes) : []));
  const largest = Math.max(1e-9, ...points.map((p) => p.stress));
  const node = Plot.plot({
    ...base,
    width,
    height: Math.max(300, Math.min(460, width * 0.52)),
    marginLeft: 48,
    marginRight: 20,
    marginTop: 28,
    marginBottom: 42,
    x: { label: `${report.axes.strain} [${report.axes.strain_unit}]`, labelAnchor: "center", labelArrow: "none", domain: [0, Math.max(1e-9, ...points.map((p) => p.strain))] },
    y: { label: `${report.axes.stress} [MPa]`, labelArrow: "none", domain: [0, largest * 1.05], nice: true },
    marks: [
      Plot.ruleY([0]),
      Plot.line(points, { x: "strain", y: "stress", z: "name", stroke: "color", strokeWidth: 1.8, strokeOpacity: (d: { fade: boolean }) => (d.fade ? 0.22 : 1) }),
      Plot.dot(all, { x: "strain", y: "stress", symbol: (d: any) => d.symbol, fill: (d: any) => d.test.color, stroke: "var(--surface)", strokeWidth: 1, r: 5 }),
      Plot.text(all.filter((m) => m.peak), { x: "strain", y: "stress", text: (d) => d.test.label, dy: -13, fill: (d) => d.test.color, fontWeight: 600, stroke: "var(--surface)", strokeWidth: 4 }),
      Plot.tip(
        points.filter((p) => !p.fade),
        Plot.pointer({ x: "strain", y: "stress", title: (d) => `${d.name}\n${d.stress.toFixed(2)} MPa at ${d.strain.toPrecision(4)} ${report.axes.strain_unit}`, fill: "var(--surface)" }),
      ),
    ],
  });
  return linked(node);
}

/** One specimen: stress, crack counts by kind on the right axis, damage stresses. */
export function damage(t: Test, axes: Axes, width: number): LinkedChart {
  const points = curvePoints(t, axes);
  const all = marks(t, axes);
  const largest = Math.max(1e-9, ...points.map((p) => p.stress)) * 1.12;
  const n = t.cracks.strain.length;
  const scale = largest / Math.max(1, n) / 1.12;
  const areas: { strain: number; low: number; high: number; kind: number }[] = [];
  const steps = 160;
  const counts = [0, 0, 0, 0];
  for (let k = 0, i = 0; k <= steps; ++k) {
    const strain = (t.end * k) / steps;
    for (; i < n && t.cracks.strain[i] <= strain; ++i) ++counts[t.cracks.kind[i]];
    let low = 0;
    counts.forEach((c, kind) => {
      areas.push({ strain: axes.strain_factor * strain, low: low * scale, high: (low + c) * scale, kind });
      low += c;
    });
  }
  const ticks = [0, 0.5, 1].map((part) => part * n);
  const label = `${axes.strain} [${axes.strain_unit}]`;
  const node = Plot.plot({
    ...base,
    width,
    height: Math.max(190, width * 0.68),
    marginLeft: 38,
    marginRight: 44,
    marginTop: 26,
    marginBottom: 34,
    x: { label, labelAnchor: "center", labelArrow: "none", ticks: 4, domain: [0, Math.max(1e-9, axes.strain_factor * t.end)] },
    y: { label: "stress [MPa]", labelArrow: "none", ticks: 5, domain: [0, largest] },
    marks: [
      Plot.areaY(areas, { x: "strain", y1: "low", y2: "high", z: "kind", fill: (d: { kind: number }) => `var(${crackKinds[d.kind].variable})`, fillOpacity: 0.55 }),
      Plot.axisY({ anchor: "left", ticks: 5, label: "stress [MPa]", labelArrow: "none" }),
      Plot.axisX({ label, labelAnchor: "center", labelArrow: "none", ticks: 4 }),
      Plot.axisY(ticks.map((v) => v * scale), { anchor: "right", label: "cracks", labelArrow: "none", tickFormat: (v) => Math.round(v / scale).toString() }),
      Plot.line(points, { x: "strain", y: "stress", stroke: "var(--ink)", strokeWidth: 1.6 }),
      Plot.dot(all, { x: "strain", y: "stress", symbol: (d: any) => d.symbol, fill: "var(--ink)", stroke: "var(--surface)", r: 4.5 }),
      ...[all.filter((m) => m.peak), all.filter((m) => !m.peak)].map((some, i) =>
        Plot.text(some, { x: "strain", y: "stress", text: "label", dx: i === 0 ? 0 : -9, dy: i === 0 ? -13 : 2, textAnchor: i === 0 ? "middle" : "end", stroke: "var(--surface)", strokeWidth: 4, fill: "var(--ink)" }),
      ),
    ],
  });
  return linked(node);
}

interface AngleOptions {
  name: string; // of the number in result.json
  label: string;
  factor: number;
  curve: Curve;
  property: string; // of laboratory points
}

/** One number over the inclination: model, theory, laboratory. */
export function overAngle(report: Report, width: number, o: AngleOptions): SVGSVGElement | HTMLElement {
  const counted = report.tests.filter((t) => t.outcome.status !== "untrusted");
  const model = counted.flatMap((t) => {
    const v = value(t, o.name);
    return t.theta === null || v === null ? [] : [{ theta: t.theta, value: v * o.factor, color: t.color, name: t.name }];
  });
  const intact = counted.flatMap((t) => {
    const v = value(t, o.name);
    return t.theta !== null || v === null ? [] : [{ value: v * o.factor }];
  });
  const theory = o.curve.theta.map((theta, i) => ({ theta, value: o.curve.value[i] * o.factor }));
  const points = report.laboratory.filter((p) => p.property === o.property).map((p: LabPoint) => ({
    theta: p.theta,
    value: p.mean * o.factor,
    low: (p.mean - (1.96 * p.sd) / Math.sqrt(p.n)) * o.factor,
    high: (p.mean + (1.96 * p.sd) / Math.sqrt(p.n)) * o.factor,
  }));
  const beside = (d: { theta: number; value: number }) =>
    points.filter((p) => p.theta === d.theta).flatMap((p) => [`laboratory ${inWords(p.value, o.label)}`, `its 95 %: ${p.low.toPrecision(3)} … ${p.high.toPrecision(3)}`, missedBy(d.value, p.value, o.property === "nu")]);
  const top = Math.max(1e-12, ...[...model, ...intact, ...theory].map((d) => d.value), ...points.map((p) => p.high));
  const far = Math.max(90, ...model.map((m) => m.theta));
  return Plot.plot({
    ...panel(width),
    x: { ...inclination, domain: [0, far], ticks: angles(far, width) },
    y: { label: o.label, labelArrow: "none", domain: [0, top * 1.06], nice: true },
    marks: [
      Plot.ruleY([0]),
      Plot.ruleY(intact, { y: "value", stroke: "var(--intact)", strokeDasharray: "2 4", strokeWidth: 1.4 }),
      Plot.text(intact, { x: 1, y: "value", text: () => "intact", frameAnchor: "left", textAnchor: "start", dy: -7, fill: "var(--muted)" }),
      Plot.line(theory, { x: "theta", y: "value", stroke: "var(--theory)", strokeWidth: 1.8, strokeDasharray: "7 4" }),
      Plot.ruleX(points, { x: "theta", y1: "low", y2: "high", stroke: "var(--ink)", strokeWidth: 1.4 }),
      Plot.dot(points, { x: "theta", y: "value", symbol: "diamond", r: 5.5, stroke: "var(--ink)", fill: "var(--surface)", strokeWidth: 1.6 }),
      Plot.line(model, { x: "theta", y: "value", stroke: "var(--muted)", strokeOpacity: 0.6 }),
      Plot.dot(model, { x: "theta", y: "value", fill: "color", r: 5, stroke: "var(--surface)", strokeWidth: 1.2, tip: true, title: (d) => [`${d.name}: ${inWords(d.value, o.label)}`, ...beside(d)].join("\n") }),
    ],
  }) as SVGSVGElement;
}

/** Share of each kind of crack, one bar per specimen. */
export function modeShare(report: Report, width: number): SVGSVGElement | HTMLElement {
  const parts = report.tests.flatMap((t) => {
    const counts = crackKinds.map((k) => value(t, k.key) ?? 0);
    const all = counts.reduce((a, b) => a + b, 0);
    return all === 0 ? [] : counts.map((c, kind) => ({ label: t.label, share: (100 * c) / all, kind, count: c }));
  });
  return Plot.plot({
    ...panel(width),
    x: { label: "specimen", labelAnchor: "center", labelArrow: "none", domain: report.tests.map((t) => t.label), padding: 0.22 },
    y: { label: "share of cracks [%]", labelArrow: "none", domain: [0, 100] },
    marks: [
      Plot.barY(parts, { x: "label", y: "share", z: "kind", fill: (d) => `var(${crackKinds[d.kind].variable})`, tip: true, title: (d) => `${d.label}: ${crackKinds[d.kind].label}\n${d.count} cracks, ${d.share.toFixed(1)} %` }),
      Plot.ruleY([0]),
    ],
  }) as SVGSVGElement;
}

const namespace = "http://www.w3.org/2000/svg";

function svg(name: string, attributes: Record<string, string | number>, text?: string): SVGElement {
  const e = document.createElementNS(namespace, name);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, String(v));
  if (text !== undefined) e.textContent = text;
  return e;
}

/** Sector of a ring between two angles in degrees, anticlockwise from +x. */
function sector(inner: number, outer: number, from: number, to: number): string {
  const at = (r: number, degrees: number) => {
    const a = (degrees * Math.PI) / 180;
    return `${(r * Math.cos(a)).toFixed(2)},${(-r * Math.sin(a)).toFixed(2)}`;
  };
  return `M${at(inner, from)}L${at(outer, from)}A${outer},${outer} 0 0 0 ${at(outer, to)}L${at(inner, to)}A${inner},${inner} 0 0 1 ${at(inner, from)}Z`;
}

/** Directions of cracks: area of a petal is proportional to their number; the line is the bedding. */
export function rose(t: Test): SVGElement {
  const R = 62;
  const root = svg("svg", { viewBox: "-78 -78 156 156", class: "rose", role: "img", "aria-label": `Crack rose of ${t.name}` });
  for (const part of [0.5, 1]) root.append(svg("circle", { r: R * part, class: "ring" }));
  root.append(svg("line", { x1: -R, x2: R, y1: 0, y2: 0, class: "ring" }), svg("line", { x1: 0, x2: 0, y1: -R, y2: R, class: "ring" }));
  const total = t.rose.tension.map((v, i) => v + t.rose.shear[i]);
  const largest = Math.max(1, ...total);
  const radius = (count: number) => R * Math.sqrt(count / largest);
  total.forEach((count, i) => {
    if (count === 0) return;
    for (const half of [0, 180]) {
      const [from, to] = [(i - 0.5) * t.rose.bin + half, (i + 0.5) * t.rose.bin + half];
      root.append(svg("path", { d: sector(0, radius(t.rose.shear[i]), from, to), class: "shear" }));
      root.append(svg("path", { d: sector(radius(t.rose.shear[i]), radius(count), from, to), class: "tension" }));
    }
  });
  if (t.theta !== null) {
    const a = (t.theta * Math.PI) / 180;
    const [x, y] = [(R + 9) * Math.cos(a), (R + 9) * Math.sin(a)];
    root.append(svg("line", { x1: -x, y1: y, x2: x, y2: -y, class: "bedding" }));
  }
  root.append(svg("text", { x: R + 3, y: -3, class: "small" }, "0°"), svg("text", { x: 4, y: -R - 4, class: "small" }, "90°"));
  root.append(svg("title", {}, `${t.name}: ${t.cracks.strain.length} cracks; the largest petal has ${largest}`));
  return root;
}

/** 95 % interval by the fit, else the standard deviation of the packings. */
function bounds(r: Comparison, factor: number) {
  if (r.low !== null && r.high !== null) return { low: r.low * factor, high: r.high * factor };
  if (r.sd_of_packings === null) return { low: null, high: null };
  return { low: (r.model! - r.sd_of_packings) * factor, high: (r.model! + r.sd_of_packings) * factor };
}

/** What one property of a calibration is drawn from. */
export interface Compared {
  rows: Comparison[]; // as judged: on unseen packings where there are
  fitted: Comparison[]; // with the intervals
  leftOut: Comparison[];
  curve: Curve; // of theory; may be empty
}

/** Laboratory, model with its 95 % band, theory and what was predicted unseen, for one property. */
export function comparison(c: Compared, factor: number, label: string, width: number): SVGSVGElement | HTMLElement {
  const theta = (r: Comparison) => r["theta [deg]"];
  const byAngle = <T extends { theta: number }>(some: T[]) => some.sort((a, b) => a.theta - b.theta);
  const lab = c.rows.map((r) => ({ theta: theta(r), value: r.laboratory.mean * factor, half: ((1.96 * r.laboratory.sd) / Math.sqrt(r.laboratory.n)) * factor }));
  const single = c.rows.flatMap((r) => (r.laboratory.specimens ?? []).map((v) => ({ theta: theta(r), value: v * factor })));
  const model = byAngle(c.rows.filter((r) => r.model !== null).map((r) => ({ theta: theta(r), value: r.model! * factor, of: r })));
  const band = byAngle(c.fitted.filter((r) => r.model !== null).map((r) => ({ theta: theta(r), ...bounds(r, factor) }))).filter((b) => b.low !== null && b.high !== null);
  const unseen = c.leftOut.filter((r) => r.model !== null).map((r) => ({ theta: theta(r), value: r.model! * factor }));
  const theory = c.curve.theta.map((t, i) => ({ theta: t, value: c.curve.value[i] * factor }));
  const told = ({ theta, value, of }: (typeof model)[number]) => {
    const [measured, interval] = [lab.find((l) => l.theta === theta)!, band.find((b) => b.theta === theta)];
    const range = (low: number, high: number) => `${low.toPrecision(3)} … ${high.toPrecision(3)} ${unitOf(label)}`.trim();
    return [
      `model ${inWords(value, label)} at ${theta}°`,
      `laboratory ${inWords(measured.value, label)}`,
      `its 95 %: ${range(measured.value - measured.half, measured.value + measured.half)}`,
      missedBy(value, measured.value, of.property === "nu"),
      interval && `${of.low !== null ? "fit, 95 %" : "packings, ± SD"}: ${range(interval.low!, interval.high!)}`,
    ].filter(Boolean).join("\n");
  };
  return Plot.plot({
    ...panel(width), // its heading says what is drawn
    marginTop: 12,
    x: { ...inclination, domain: [-3, 93], ticks: angles(90, width) },
    y: { label: null, nice: true, zero: true },
    marks: [
      Plot.ruleY([0]),
      Plot.areaY(band, { x: "theta", y1: "low", y2: "high", fill: "var(--accent)", fillOpacity: 0.16 }),
      Plot.ruleX(band.length === 1 ? band : [], { x: "theta", y1: "low", y2: "high", stroke: "var(--accent)", strokeWidth: 2 }),
      Plot.line(theory, { x: "theta", y: "value", stroke: "var(--theory)", strokeWidth: 1.6, strokeDasharray: "6 4" }),
      Plot.line(model, { x: "theta", y: "value", stroke: "var(--accent)", strokeWidth: 2.2 }),
      Plot.ruleX(lab, { x: "theta", y1: (d) => d.value - d.half, y2: (d) => d.value + d.half, stroke: "var(--ink)", strokeWidth: 1.4 }),
      Plot.dot(single, { x: "theta", y: "value", dx: -7, r: 2.2, fill: "var(--ink)", fillOpacity: 0.5 }),
      Plot.dot(lab, { x: "theta", y: "value", symbol: "diamond", r: 5, stroke: "var(--ink)", fill: "var(--surface)", strokeWidth: 1.5 }),
      Plot.dot(unseen, { x: "theta", y: "value", symbol: "times", dx: 7, r: 4, stroke: "var(--pull)", strokeWidth: 1.8 }),
      Plot.dot(model, { x: "theta", y: "value", fill: "var(--accent)", r: 3.4, tip: true, title: told }),
    ],
  }) as SVGSVGElement;
}

/** Several series of means with intervals, one colour each. */
export interface Series {
  name: string;
  color: string;
  bold: boolean;
  points: Spread[];
}

export function seriesChart(series: Series[], factor: number, labels: { x: string; y: string }, width: number): SVGSVGElement | HTMLElement {
  const points = series.flatMap((s) => s.points.map((p) => ({ x: p.at, y: p.mean * factor, low: (p.mean - (p.half ?? 0)) * factor, high: (p.mean + (p.half ?? 0)) * factor, s })));
  const overAngles = labels.x.includes("θ");
  const [low, high] = [Math.min(...points.map((p) => p.y)), Math.max(...points.map((p) => p.y))];
  const wide = low > 0 && high > 30 * low; // no linear axis would show the small ones
  return Plot.plot({
    ...panel(width, 54),
    x: { label: labels.x, labelAnchor: "center", labelArrow: "none", ...(overAngles ? { domain: [0, 90], ticks: angles(90, width) } : { zero: true }) },
    y: { label: labels.y, labelArrow: "none", nice: true, ...(wide ? { type: "log" } : { zero: true }) },
    marks: [
      Plot.line(points, { x: "x", y: "y", z: (d) => d.s.name, stroke: (d) => d.s.color, strokeWidth: (d) => (d.s.bold ? 2.8 : 1.6) }),
      Plot.ruleX(points.filter((p) => p.high > p.low), { x: "x", y1: "low", y2: "high", stroke: (d) => d.s.color, strokeWidth: 1.2 }),
      Plot.dot(points, { x: "x", y: "y", fill: (d) => d.s.color, r: 4, stroke: "var(--surface)", tip: true, title: (d) => `${d.s.name}\n${inWords(d.y, labels.y)}${d.high > d.low ? `, 95 %: ${d.low.toPrecision(3)} … ${d.high.toPrecision(3)}` : ""}\nat ${overAngles ? `${d.x}°` : `${d.x.toPrecision(3)} of the base`}` }),
    ],
  }) as SVGSVGElement;
}

/** Stress of a test at an axial strain, straight between rows [Pa]. */
export function stressAt(t: Test, strain: number): number {
  const i = lastUpTo(t.strain, strain);
  if (i < 0) return t.stress[0] ?? 0;
  if (i + 1 >= t.strain.length) return t.stress[t.stress.length - 1];
  const part = (strain - t.strain[i]) / (t.strain[i + 1] - t.strain[i] || 1);
  return t.stress[i] + part * (t.stress[i + 1] - t.stress[i]);
}

// Charts of the page to work in: what the laboratory measured, how a calibration goes.
import * as Plot from "@observablehq/plot";
import { angles, base, inclination, panel } from "../charts";
import { readable } from "../units";
import { Curve, Narrowing, Pressed, Target } from "./server";

type Drawn = SVGSVGElement | HTMLElement;

/** Means of the laboratory with their 95 %, single specimens, and theory through them. */
export function measured(targets: Target[], curve: Curve | undefined, factor: number, unit: string, width: number): Drawn {
  const points = targets.map((t) => ({ theta: t.theta, value: t.mean * factor, low: t.low * factor, high: t.high * factor, n: t.n }));
  const single = targets.flatMap((t) => (t.specimens ?? []).map((v) => ({ theta: t.theta, value: v * factor })));
  const theory = (curve?.theta ?? []).map((theta, i) => ({ theta, value: curve!.value[i] * factor }));
  return Plot.plot({
    ...panel(width),
    marginTop: 12,
    x: { ...inclination, domain: [-3, 93], ticks: angles(90, width) },
    y: { label: null, nice: true, zero: true },
    marks: [
      Plot.ruleY([0]),
      Plot.line(theory, { x: "theta", y: "value", stroke: "var(--theory)", strokeWidth: 1.8, strokeDasharray: "7 4" }),
      Plot.ruleX(points, { x: "theta", y1: "low", y2: "high", stroke: "var(--ink)", strokeWidth: 1.4 }),
      Plot.dot(single, { x: "theta", y: "value", dx: -7, r: 2.2, fill: "var(--ink)", fillOpacity: 0.5 }),
      Plot.dot(points, { x: "theta", y: "value", symbol: "diamond", r: 5.5, stroke: "var(--ink)", fill: "var(--surface)", strokeWidth: 1.6, tip: true, title: (d) => `${[d.value.toPrecision(4), unit].join(" ").trim()} at ${d.theta}°\n95 % of the mean ${d.low.toPrecision(3)} … ${d.high.toPrecision(3)}\n${d.n} specimen${d.n === 1 ? "" : "s"}` }),
    ],
  }) as Drawn;
}

/** 1, 2, 5 of each power of ten between the ends; where these are many, powers alone. */
function logTicks(low: number, high: number): number[] {
  const powers = Array.from({ length: 40 }, (_, i) => 10 ** (i - 20)).filter((p) => p <= high && 10 * p >= low);
  const ticks = (powers.length > 3 ? [1] : [1, 2, 5]).flatMap((k) => powers.map((p) => k * p));
  return ticks.filter((t) => t >= low && t <= high);
}

const shortNumber = (v: number) => (v >= 1e4 || (v > 0 && v < 1e-3) ? v.toExponential(0).replace("e+", "e") : String(+v.toPrecision(2)));

/** Interval and estimate of a parameter, step by step, inside the values that are admitted. */
export function narrowing(p: Narrowing, width: number): Drawn {
  const [low, high] = p.box;
  const [factor, unit] = readable(high, p.unit);
  const steps = p.steps.map((s, i) => ({ step: i + 1, value: s.value * factor, low: (s.low ?? low) * factor, high: (s.high ?? high) * factor }));
  const logarithmic = low > 0 && high > 10 * low;
  return Plot.plot({
    ...base,
    width,
    height: 150,
    marginLeft: 48,
    marginTop: 24,
    marginBottom: 32,
    x: { label: "step", labelAnchor: "center", labelArrow: "none", domain: [0.5, Math.max(4, steps.length) + 0.5], ticks: steps.map((s) => s.step), tickFormat: "d" },
    y: { label: unit || null, labelArrow: "none", type: logarithmic ? "log" : "linear", domain: [low * factor, high * factor], ticks: logarithmic ? logTicks(low * factor, high * factor) : 4, tickFormat: shortNumber },
    marks: [
      Plot.ruleX(steps, { x: "step", y1: "low", y2: "high", stroke: "var(--accent)", strokeOpacity: 0.35, strokeWidth: Math.min(14, width / 20), clip: true }),
      Plot.line(steps, { x: "step", y: "value", stroke: "var(--accent)", strokeWidth: 1.6, clip: true }),
      Plot.dot(steps, { x: "step", y: "value", fill: "var(--accent)", r: 3, tip: true, title: (d) => `step ${d.step}: ${d.value.toPrecision(3)} ${unit}\n${d.low.toPrecision(3)} … ${d.high.toPrecision(3)}` }),
    ],
  }) as Drawn;
}

/** How far the axes go: strain [%], stress [MPa]. */
export interface Reach {
  strain: number;
  stress: number;
}

/** 1, 2 or 5 of a power of ten, not below a value. */
function round(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find((k) => k * power >= value * (1 - 1e-9))!;
}

/** Growing, whatever the sign of what is recorded: tension grows upwards, too. */
function upwards(p: Pressed) {
  const sign = Math.max(0, ...p.stress) < -Math.min(0, ...p.stress) ? -1 : 1;
  return p.strain.map((s, i) => ({ strain: 100 * sign * s, stress: 1e-6 * sign * p.stress[i] }));
}

/** Axes that only grow, in few steps, over all specimens of a kind of test. */
export function reached(p: Pressed, known: Map<string, Reach>): Reach {
  const before = known.get(p.test) ?? { strain: 0.1, stress: 1 };
  const points = upwards(p);
  const far = (least: number, values: number[]) => round(Math.max(least, ...values));
  const now = { strain: far(before.strain, points.map((d) => d.strain)), stress: far(before.stress, points.map((d) => d.stress)) };
  known.set(p.test, now);
  return now;
}

/** The specimen that is in the press now, as far as it has come. */
export function growing(p: Pressed, axes: Reach, width: number): Drawn {
  const points = upwards(p);
  return Plot.plot({
    ...base,
    width,
    height: Math.max(200, Math.min(300, width * 0.55)),
    marginLeft: 48,
    marginTop: 26,
    marginBottom: 38,
    x: { label: "strain [%]", labelAnchor: "center", labelArrow: "none", domain: [Math.min(0, ...points.map((d) => d.strain)), axes.strain], ticks: 5 },
    y: { label: "stress [MPa]", labelArrow: "none", domain: [Math.min(0, ...points.map((d) => d.stress)), axes.stress] },
    marks: [Plot.ruleY([0]), Plot.line(points, { x: "strain", y: "stress", stroke: "var(--accent)", strokeWidth: 1.8 }), Plot.dot(points.slice(-1), { x: "strain", y: "stress", fill: "var(--accent)", r: 4 })],
  }) as Drawn;
}

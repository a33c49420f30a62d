// Figures of what is under way: how a calibration narrows its parameters, what is in the press.
import { Panel, axis, series } from "../figure";
import { readable } from "../units";
import { Narrowing } from "./server";

const panel = (x: Panel["x"], y: Panel["y"], some: Panel["series"]): Panel => ({ title: "", caption: "", x, y, right: null, series: some, framed: true, aside: false });

/** Interval and estimate of a parameter, step by step, inside the values that are admitted. */
export function narrowing(p: Narrowing): Panel {
  const [low, high] = p.box;
  const [factor, unit] = readable(high, p.unit);
  const logarithmic = low > 0 && high > 10 * low;
  const x = p.steps.map((_, i) => i + 1);
  const inside = (v: number | null, end: number) => Math.min(high, Math.max(low, v ?? end)) * factor;
  const ends = { low: p.steps.map((s) => inside(s.low, low)), high: p.steps.map((s) => inside(s.high, high)) };
  const y = p.steps.map((s) => inside(s.value, low));
  return panel(axis("step", "", 0.5, Math.max(4, x.length) + 0.5, { names: ["", ...x.map(String)] }), axis(p.symbol, unit, low * factor, high * factor, { logarithmic }), [
    series("boxes", "interval", { name: "95 %", x, ...ends, width: 0.5 }),
    series("line", "model", { x, y }),
    series("points", "model", { name: "estimate", x, y }),
  ]);
}

/** How the specimen in the press has done so far. */
interface Pressed {
  test: string;
  strain: number[];
  stress: number[]; // [Pa]
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
  return { x: p.strain.map((s) => 100 * sign * s), y: p.stress.map((s) => 1e-6 * sign * s) };
}

/** Axes that only grow, in few steps, over all specimens of a kind of test. */
export function reached(p: Pressed, known: Map<string, Reach>): Reach {
  const before = known.get(p.test) ?? { strain: 0.1, stress: 1 };
  const { x, y } = upwards(p);
  const now = { strain: round(Math.max(before.strain, ...x)), stress: round(Math.max(before.stress, ...y)) };
  known.set(p.test, now);
  return now;
}

/** The specimen that is in the press now, as far as it has come. */
export function growing(p: Pressed, axes: Reach): Panel {
  const { x, y } = upwards(p);
  return panel(axis("strain", "%", Math.min(0, ...x), axes.strain), axis("stress", "MPa", Math.min(0, ...y), axes.stress), [
    series("line", "model", { name: "now", x, y }),
    series("points", "model", { x: x.slice(-1), y: y.slice(-1) }),
  ]);
}

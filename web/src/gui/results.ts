// All that has come of a rock, laid over one another: over the inclination, as curves, over the confining stress, and as it broke.
import { RawTest, cracksOf, readScene } from "../data";
import { h, table } from "../dom";
import { Figure, axisLabel, draw, legend } from "../figure";
import { labelSpecimens } from "../labels";
import { savable } from "../save";
import { readable } from "../units";
import { Shown, Viewer } from "../viewer";
import { attempt, button, keyed, objections, select } from "./controls";
import { Figures } from "./figures";
import { redrawOnTheme } from "./live";
import { RockAnswer, RockTest, Tested, ask } from "./server";

interface Results {
  over_theta: Figure;
  curves: Figure;
  over_sigma_3: Figure;
}

export interface ResultsView {
  node: HTMLElement;
  show(answer: RockAnswer): void;
}

const over = (t: RockTest) => t.state === "finished" || t.state === "stopped";

const tallest = 480; // of a single specimen [CSS pixels]

/** One figure with its heading and its signs; away where it has no panel. */
function part(title: string) {
  const charts = new Figures("grid small", true);
  const signs = h("div");
  const node = h("div", {}, h("h3", {}, title), signs, charts.node);
  node.hidden = true;
  return {
    node,
    show(f: Figure) {
      node.hidden = f.panels.length === 0;
      charts.show(f.panels.map((p) => ({ name: [axisLabel(p.y), p.title, "all results"].filter(Boolean).join(", "), shown: p, caption: p.caption, draw: (width) => draw(p, width, { aspect: f.aspect }).node })));
      keyed(signs, f.panels.map((p) => p.series.map((s) => s.name)), () => [f.panels.length > 0 && legend(f.panels)]);
    },
  };
}

const valueOf = (s: Tested) => {
  if (s.value == null || !s.unit) return "–";
  const [factor, unit] = readable(s.value, s.unit);
  return `${(s.value * factor).toPrecision(3)} ${unit}`.trim();
};

/** The specimens of one test, broken. */
function brokenView(rock: string) {
  const wrong = objections();
  const overlay = h("div", { class: "cells" });
  const frame = h("div", { class: "viewer" });
  let tests: RockTest[] = [];
  let chosen = "";
  let viewer: Viewer | null = null;
  let shown = "";
  const choose = select([], (name) => {
    chosen = name;
    void open();
  });
  choose.setAttribute("aria-label", "Test whose specimens are shown");
  const go = button("Show how they broke", () => void open());
  const sized = new ResizeObserver(() => viewer?.layout());
  redrawOnTheme(() => {
    viewer?.readColors();
    viewer?.draw();
  });

  async function open() {
    await attempt(wrong, async () => {
      const name = chosen;
      const broken = await ask<(RawTest & { sign: number })[]>(`/api/broken?name=${encodeURIComponent(rock)}&test=${encodeURIComponent(name)}`);
      if (name === chosen) draw(name, broken);
    });
  }

  function draw(name: string, broken: (RawTest & { sign: number })[]) {
    const made = tests.find((t) => t.name === name)?.specimens ?? [];
    viewer?.end();
    const canvas = h("canvas", { role: "img", "aria-label": `Specimens of ${name}, broken` });
    frame.replaceChildren(canvas, overlay);
    const all = broken.map((t): Shown => ({ cracks: cracksOf(t.cracks), bedding: t.bedding, end: t.end, load: t.scene ? () => readScene(t.scene!, t.sign) : null }));
    viewer = new Viewer(canvas, all, () => labelSpecimens(viewer!, overlay, label), () => Math.max(160, innerHeight - tallest), undefined, true);
    const label = (i: number) => {
      const of = made.find((s) => s.specimen === broken[i].result.specimen);
      return { head: broken[i].label === "intact" ? "intact" : `θ = ${broken[i].label}`, color: "var(--ink)", foot: [h("strong", {}, of ? `${of.strength ?? ""} ${valueOf(of)}`.trim() : "")] };
    };
    sized.disconnect();
    sized.observe(frame);
    go.hidden = true;
    shown = name;
    viewer.layout();
    void viewer.load();
  }

  const node = h("div", { class: "broken" }, h("h3", {}, "As they broke"), h("div", { class: "tools" }, choose, go), wrong, frame);
  return {
    node,
    show(all: RockTest[]) {
      tests = all.filter((t) => over(t) && t.specimens.length > 0);
      node.hidden = tests.length === 0;
      if (!tests.some((t) => t.name === chosen)) chosen = tests.at(-1)?.name ?? "";
      keyed(choose, tests.map((t) => t.name), () => tests.map((t) => h("option", { value: t.name }, t.name)));
      choose.value = chosen;
      if (shown && !tests.some((t) => t.name === shown)) {
        frame.replaceChildren();
        shown = "";
        go.hidden = false;
      }
    },
  };
}

/** A strength of each specimen of each test. */
function numbers(tests: RockTest[]): HTMLElement {
  const rows = tests.flatMap((t) => t.specimens.map((s) => [t.name, s.theta === null ? "intact" : String(s.theta), s.strength ?? "–", valueOf(s), s.grade ?? "–"]));
  return savable(table("Results of all tests", ["test", "θ [°]", "strength", "value", "quality"], rows, "All tests", [2, 4]));
}

export function resultsView(rock: string): ResultsView {
  const none = h("p", { class: "muted" }, "Nothing has been computed yet.");
  const wrong = objections();
  const parts = { over_theta: part("Over the inclination"), curves: part("Curves of the tests"), over_sigma_3: part("Over the confining stress") };
  const broken = brokenView(rock);
  const list = h("div");
  let drawn = "";

  async function load(now: string, calibration: string) {
    const results = await ask<Results>(`/api/results?name=${encodeURIComponent(rock)}&calibration=${encodeURIComponent(calibration)}`);
    if (now !== drawn) return; // of what stood before
    for (const [name, view] of Object.entries(parts)) view.show(results[name as keyof Results]);
  }

  return {
    node: h("div", {}, none, wrong, parts.over_theta.node, parts.curves.node, parts.over_sigma_3.node, broken.node, list),
    show(answer) {
      const made = answer.tests.filter((t) => t.specimens.length > 0);
      const c = answer.calibration;
      const computed = made.length > 0 || c.verdict !== null;
      none.hidden = computed;
      broken.show(answer.tests);
      keyed(list, made.map((t) => [t.name, t.specimens]), () => (made.length > 0 ? [numbers(made)] : []));
      const now = JSON.stringify([c.folder, c.verdict?.sentence, answer.stamp, made.map((t) => [t.name, t.state, t.specimens])]);
      if (!computed || now === drawn) return;
      drawn = now;
      void attempt(wrong, () => load(now, answer.calibrations.some((b) => b.folder === c.folder) ? c.folder : ""));
    },
  };
}

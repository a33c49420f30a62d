// What the check says of the table: how it was read, what it holds, what it determines.
import { Child, fold, h, table } from "../dom";
import { Panel, axisLabel, draw, legend } from "../figure";
import { argument, command, counted, keyed, plainly } from "./controls";
import { Figures } from "./figures";
import { Checked, Finding, Target, isUnbedded } from "./server";

export interface FindingsView {
  node: HTMLElement;
  busy(words: string): void;
  show(checked: Checked, words: string): void;
  redraw(): void; // the angle that is looked at is another
}

const list = (items: string[] | null | undefined, style = ""): Child => (items && items.length > 0 ? h("ul", { class: `findings ${style}` }, ...items.map((s) => h("li", {}, plainly(s)))) : null);

const texts = (findings: Finding[]) => findings.map((f) => f.text);

/** `angles`: rocks without layers have none. */
function numbers(targets: Target[], angles: boolean): HTMLElement {
  const shown = (t: Target, v: number | null) => (v === null ? "–" : (v * t.factor).toPrecision(4));
  return table(
    "Means of the laboratory",
    ["property", ...(angles ? ["θ [°]"] : []), "mean", "± SD", "specimens", "95 % of the mean"],
    targets.map((t) => [t.title, ...(angles ? [String(t.theta)] : []), shown(t, t.mean), shown(t, t.sd), String(t.n), `${shown(t, t.low)} … ${shown(t, t.high)}`]),
  );
}

function determined(checked: Checked): Child {
  const rows = checked.parameters ?? [];
  if (rows.length === 0) return null;
  const more = (p: (typeof rows)[number]) => (p.determined ? (p.rests_on?.text ?? "") : p.next ? `next: ${p.next.text}` : "no test of a table determines it");
  return table(
    "What the data determine",
    ["parameter", "determined", "expected interval", "rests on, or next test"],
    rows.map((p) => [p.symbol, p.determined ? "yes" : "no", p.interval ?? "known after the fit", more(p)]),
    null,
    [3],
  );
}

/** `specimen` stands above all; `marked` adds to a panel what is known at its angle. */
export function findingsView(rock: string, specimen: HTMLElement, marked: (panel: Panel) => Panel): FindingsView {
  let panels: Panel[] = [];
  const state = h("span", { role: "status" });
  const busy = h("span", { class: "muted" }); // not read aloud at every key
  const doubts = h("div"); // before all else
  const forecast = h("div");
  const charts = new Figures("grid small");
  const signs = h("div");
  const words = h("div");
  const redraw = () =>
    charts.show(
      panels.map((p) => {
        const shown = marked(p);
        return { name: [axisLabel(p.y), p.title].filter(Boolean).join(", "), shown, caption: p.caption, draw: (width) => draw(shown, width, { bare: true }).node };
      }),
    );
  return {
    node: h("div", {}, h("p", { class: "state" }, state, " ", busy), doubts, specimen, charts.node, signs, forecast, words, command(`phyllite rock check ${argument(`${rock}.toml`)}`)),
    redraw,
    busy: (words) => (busy.textContent = words),
    show(checked, says) {
      busy.textContent = "";
      state.textContent = says;
      const targets = checked.targets ?? [];
      const remarks = [...checked.models, ...texts(checked.limits), ...checked.in_maps, ...texts(checked.forecast.slice(1))];
      const bedded = !isUnbedded(checked);
      panels = bedded ? (checked.figure?.panels ?? []) : [];
      redraw();
      keyed(signs, panels.map((p) => p.series.map((s) => s.name)), () => [panels.length > 0 && legend(panels)]);
      keyed(doubts, checked.doubts, () => checked.doubts.map((d) => h("p", { class: "notice" }, d.text)));
      keyed(forecast, checked.summary, () => [list(texts(checked.summary.filter((f) => !checked.doubts.some((d) => d.text === f.text))))]);
      keyed(words, checked, () => [
        !bedded && targets.length > 0 && numbers(targets, false),
        list(texts(checked.statements)),
        checked.parameters && checked.parameters.length > 0 && h("h3", {}, "What the data determine"),
        determined(checked),
        remarks.length > 0 && fold(counted(remarks.length, "remark"), list(remarks)),
        bedded && targets.length > 0 && fold("Means of the table", numbers(targets, true)),
        checked.notes.length > 0 && h("h3", {}, "How the files were understood"),
        list(checked.notes, "muted"),
      ]);
    },
  };
}

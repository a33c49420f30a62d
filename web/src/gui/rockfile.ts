// The rock file: what is asked for most by choosing, all of it as text. A choice changes its line of the text.
import { Child, fold, h } from "../dom";
import { field, input, keyed, select, textArea } from "./controls";
import { Checked, Project, isUnbedded } from "./server";
import { showTexts } from "./steps";
import { problemItem } from "./table";
import { get, isElsewhere, quoted, set } from "./toml";

interface Entry {
  table: string;
  key: string;
  node: HTMLInputElement | HTMLSelectElement;
  place: HTMLElement;
  hint: HTMLElement;
}

export interface RockFileView {
  node: HTMLElement;
  show(toml: string, file: string): void;
  mark(checked: Checked | null): void;
}

const sizes: [string, string, string][] = [
  ["specimen", "width", "Width of the specimens"],
  ["specimen", "height", "Height of the specimens"],
  ["bedding", "spacing", "Distance of the layers"],
];

/** On the first page of the report. */
const ofReport = ["project", "client", "laboratory", "author"];

/** Means nothing to a rock without layers. */
const ofLayers = (e: Entry) => e.key === "layers" || e.table === "bedding";

export function rockFileView(project: Project, edit: (toml: string, step: string) => void): RockFileView {
  let text = "";
  const entries: Entry[] = [];
  const change = (table: string, key: string, value: string) => edit(set(text, table, key, value === "" ? null : quoted(value)), `rock file ${table}.${key}`);
  const entered = (table: string, key: string, node: Entry["node"], label: string): HTMLElement => {
    const hint = h("span");
    const place = field(label, node, hint);
    entries.push({ table, key, node, place, hint });
    return place;
  };
  const chosen = (key: "E_is" | "layers" | "matrix", label: string): HTMLElement => {
    const options = project.choices[key];
    const words = (o: string) => (o === "choose" ? "the best model" : o.replaceAll("_", " "));
    const node = select([["", `not given: ${words(options[0])}`], ...options.map((o): [string, string] => [o, words(o)])], (v) => change("", key, v));
    return entered("", key, node, label);
  };
  const typed = (table: string, key: string, label: string): HTMLElement => {
    const node = input((v) => change(table, key, v.trim()), { placeholder: "not given" });
    return entered(table, key, node, label);
  };
  const area = textArea((t) => edit(t, "typing the rock file"), { id: "rock-text", "aria-describedby": "rock-problems" });
  const label = h("label", { for: "rock-text" }, "Rock file as text");
  const name = h("code");
  const problems = h("ul", { class: "problems", id: "rock-problems" });
  const fields: Child[] = [chosen("E_is", "What E is"), chosen("layers", "Model of the layers"), chosen("matrix", "Model of the matrix"), ...sizes.map((of) => typed(...of))];
  return {
    node: h("div", {}, h("div", { class: "fields" }, ...fields), fold("First page of the report", h("div", { class: "fields" }, ...ofReport.map((key) => typed("report", key, key[0].toUpperCase() + key.slice(1))))), h("div", { class: "field as-text" }, label, area.node), problems, h("p", { class: "muted as-text" }, "The file: ", name)),
    show(toml, file) {
      text = toml;
      area.set(toml);
      name.textContent = file;
      for (const e of entries) {
        e.node.disabled = e.table !== "" && isElsewhere(toml, e.table);
        e.hint.textContent = e.node.disabled ? "set in the text" : "";
      }
      for (const e of entries) if (e.node !== document.activeElement || e.node instanceof HTMLSelectElement) fit(e.node, get(toml, e.table, e.key));
    },
    mark(checked) {
      const all = checked?.problems.filter((p) => p.where === "rock") ?? [];
      const layered = !checked || !isUnbedded(checked);
      for (const e of entries) e.place.hidden = ofLayers(e) && !layered && get(text, e.table, e.key) === "";
      area.node.setAttribute("aria-invalid", String(all.length > 0));
      keyed(problems, all, () => all.map((p) => problemItem(p, (line) => (showTexts(), area.goTo(line)))));
    },
  };
}

/** A value that is no choice is shown nevertheless: the check says what is wrong with it. */
function fit(node: HTMLInputElement | HTMLSelectElement, value: string) {
  if (node instanceof HTMLSelectElement && ![...node.options].some((o) => o.value === value)) node.append(h("option", { value }, value));
  if (node.value !== value) node.value = value;
}

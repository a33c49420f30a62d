// What a calibration may be asked for: a control for each option of the one list (src/jobs/calibration_options.cpp).
import { h } from "../dom";
import { argument, field, input, select, ticked } from "./controls";
import { chosenBefore, keepChosen } from "./drafts";
import { Option } from "./server";

type Value = Option["default"];

export interface OptionForm {
  node: HTMLElement;
  wrong(): boolean; // a value is none
  asked(): Record<string, Value>; // what is not as by default
  words(): string; // the same at the end of a command
  annotate(path: string, words: Record<string, [short: string, long: string]>): void; // what the choices of an option come to; long: of the one that is chosen
}

interface Control {
  option: Option;
  place: HTMLElement;
  value(): Value | null; // null: none that the option can have
  node: HTMLInputElement | HTMLSelectElement;
}

const inWords = (option: Option, choice: string) => choice.replaceAll("_", " ") + (choice === String(option.default) ? " (usual)" : "");

/** `kept`: as it was chosen last, undefined: as by default. */
function control(option: Option, kept: string | undefined, chosen: (text: string) => void): Control {
  const usual = String(option.default);
  if (option.kind === "boolean") {
    const node = h("input", { type: "checkbox" });
    node.checked = (kept ?? usual) === "true";
    node.addEventListener("change", () => chosen(String(node.checked)));
    return { option, place: ticked(option.title, node, option.meaning), node, value: () => node.checked };
  }
  if (option.kind === "choice") {
    const words = (o: string): [string, string] => [o, inWords(option, o)];
    const node = select([...(usual === "" ? [["", "as the rock file says"] as [string, string]] : []), ...option.choices.map(words)], chosen);
    node.value = kept ?? usual;
    if (node.selectedIndex < 0) node.value = usual; // a word of another version
    return { option, place: field(option.title, node, option.meaning), node, value: () => node.value };
  }
  const wrong = h("p", { class: "objection", role: "alert" });
  const number = () => (/^\s*\d{1,9}\s*$/.test(node.value) && Number(node.value) >= option.least && Number(node.value) <= option.most ? Number(node.value) : null);
  const say = () => {
    wrong.textContent = number() === null ? `A whole number from ${option.least} to ${option.most}.` : "";
    node.setAttribute("aria-invalid", String(number() === null));
  };
  const node = input((text) => {
    say();
    chosen(text);
  }, { inputmode: "numeric" });
  node.value = kept ?? usual;
  say();
  return { option, place: h("div", {}, field(option.title, node, option.meaning), wrong), node, value: number };
}

/** `store`: where the browser keeps what is chosen. */
export function optionForm(options: Option[], store: string, changed: () => void): OptionForm {
  const kept = chosenBefore<Record<string, string>>(store);
  const controls = options
    .filter((o) => o.on_page)
    .map((o) =>
      control(o, kept[o.path], (text) => {
        kept[o.path] = text;
        keepChosen(store, kept);
        tell();
        changed();
      }),
    );
  const asked = () => controls.flatMap((c): [Option, Value][] => {
    const value = c.value();
    return value === null || value === c.option.default ? [] : [[c.option, value]];
  });
  const told = new Map<string, Record<string, [string, string]>>();
  /** Below the control: what its choice comes to. */
  function tell() {
    for (const c of controls) {
      const words = told.get(c.option.path)?.[String(c.value())]?.[1];
      if (words === undefined) continue;
      const line = c.place.querySelector(".comes-to") ?? c.place.querySelector("select")!.insertAdjacentElement("afterend", h("strong", { class: "comes-to" }))!;
      line.textContent = words;
    }
  }
  return {
    node: h("div", { class: "fields" }, ...controls.map((c) => c.place)),
    annotate(path, words) {
      const of = controls.find((c) => c.option.path === path);
      if (!(of?.node instanceof HTMLSelectElement)) return;
      for (const o of of.node.options) o.textContent = [inWords(of.option, o.value), words[o.value]?.[0]].filter(Boolean).join(": ");
      told.set(path, words);
      tell();
    },
    wrong: () => controls.some((c) => c.value() === null),
    asked: () => Object.fromEntries(asked().map(([o, value]) => [o.path, value])),
    words: () => asked().map(([o, value]) => ` ${o.word}${value === true ? "" : ` ${argument(String(value))}`}`).join(""),
  };
}

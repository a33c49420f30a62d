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
}

interface Control {
  option: Option;
  place: HTMLElement;
  value(): Value | null; // null: none that the option can have
}

/** `kept`: as it was chosen last, undefined: as by default. */
function control(option: Option, kept: string | undefined, chosen: (text: string) => void): Control {
  const usual = String(option.default);
  if (option.kind === "boolean") {
    const node = h("input", { type: "checkbox" });
    node.checked = (kept ?? usual) === "true";
    node.addEventListener("change", () => chosen(String(node.checked)));
    return { option, place: ticked(option.title, node, option.meaning), value: () => node.checked };
  }
  if (option.kind === "choice") {
    const words = (o: string): [string, string] => [o, o.replaceAll("_", " ") + (o === usual ? " (usual)" : "")];
    const node = select([...(usual === "" ? [["", "as the rock file says"] as [string, string]] : []), ...option.choices.map(words)], chosen);
    node.value = kept ?? usual;
    if (node.selectedIndex < 0) node.value = usual; // a word of another version
    return { option, place: field(option.title, node, option.meaning), value: () => node.value };
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
  return { option, place: h("div", {}, field(option.title, node, option.meaning), wrong), value: number };
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
        changed();
      }),
    );
  const asked = () => controls.flatMap((c): [Option, Value][] => {
    const value = c.value();
    return value === null || value === c.option.default ? [] : [[c.option, value]];
  });
  return {
    node: h("div", { class: "fields" }, ...controls.map((c) => c.place)),
    wrong: () => controls.some((c) => c.value() === null),
    asked: () => Object.fromEntries(asked().map(([o, value]) => [o.path, value])),
    words: () => asked().map(([o, value]) => ` ${o.word}${value === true ? "" : ` ${argument(String(value))}`}`).join(""),
  };
}

// Small parts that every section is made of.
import { Child, copyButton, h } from "../dom";
import { Option, fileAddress } from "./server";

export function button(text: string, act: () => void, attributes: Record<string, string> = {}): HTMLButtonElement {
  const b = h("button", { type: "button", ...attributes }, text);
  b.addEventListener("click", act);
  return b;
}

let fields = 0;

/** A control with its label above and a word on it below. */
export function field<T extends HTMLElement>(label: string, control: T, hint: Child = null): HTMLElement {
  control.id ||= `field-${++fields}`;
  const small = hint && h("small", { id: `${control.id}-hint`, class: "muted" }, hint);
  if (small) control.setAttribute("aria-describedby", small.id);
  return h("div", { class: "field" }, h("label", { for: control.id }, label), control, small);
}

/** A box to be ticked, with its label beside it and a word on it below. */
export function ticked(label: string, control: HTMLInputElement, hint: string): HTMLElement {
  control.id ||= `field-${++fields}`;
  const small = h("small", { id: `${control.id}-hint`, class: "muted" }, hint);
  control.setAttribute("aria-describedby", small.id);
  return h("div", { class: "field" }, h("div", { class: "ticked" }, control, h("label", { for: control.id }, label)), small);
}

export function select(options: [string, string][], changed: (value: string) => void): HTMLSelectElement {
  const s = h("select", {}, ...options.map(([v, text]) => h("option", { value: v }, text)));
  s.addEventListener("change", () => changed(s.value));
  return s;
}

export function input(changed: (value: string) => void, attributes: Record<string, string> = {}): HTMLInputElement {
  const i = h("input", { type: "text", autocomplete: "off", spellcheck: "false", ...attributes });
  i.addEventListener("input", () => changed(i.value));
  return i;
}

export const counted = (n: number, thing: string) => `${n} ${thing}${n === 1 ? "" : "s"}`;

/** A word of a command line. */
export const argument = (text: string) => (/^[\w./-]+$/.test(text) ? text : `'${text}'`);

/** The same as a command line. */
export function command(text: string, lead = "As a command: "): HTMLElement {
  return h("p", { class: "command" }, h("span", { class: "muted" }, lead), h("code", {}, text), " ", copyButton(text));
}

/** Titles of the controls that stand for options of commands, by option: of all options of the project. */
const titles = new Map<string, string>();
export const nameOptions = (options: Option[]) => options.filter((o) => o.title).forEach((o) => titles.set(o.word, o.title));

/** A sentence of the program in the words of the page: options are named as their controls, and files can be opened. */
export function worded(text: string, files: string[] = []): Child[] {
  const told = (part: string): Child => {
    const file = files.find((f) => f.endsWith(`/${part}`));
    return titles.has(part) ? `“${titles.get(part)}”` : file ? fileLink(file, part) : part;
  };
  return text.replace(/^command line: /gm, "").split(/(--[a-z][a-z-]+|[\w-]+\.(?:txt|toml|html|json)\b)/).map(told);
}

/** The same where there are no links. */
export const plainly = (text: string) => worded(text).join("");

/** Does what a button asks for; what the program says against it stands at the place. */
export async function attempt(place: HTMLElement, act: () => Promise<unknown>) {
  place.textContent = "";
  try {
    await act();
  } catch (error) {
    place.textContent = plainly((error as Error).message);
  }
}

/** A button that stops what runs: the end takes a moment, for what is finished is kept. */
export function stopper(text: string, wrong: HTMLElement, act: () => Promise<unknown>): { nodes: Node[]; show(running: boolean): void } {
  const word = h("span", { class: "muted", role: "status" });
  const say = (stopping: boolean) => {
    b.disabled = stopping;
    word.textContent = stopping ? "Stopping; what is finished is kept." : "";
  };
  const b = button(
    text,
    () =>
      attempt(wrong, async () => {
        say(true);
        await act().catch((error) => {
          say(false);
          throw error;
        });
      }),
    { title: "as Ctrl-C in a terminal" },
  );
  return {
    nodes: [b, word],
    show(running) {
      b.hidden = !running;
      if (!running) say(false);
    },
  };
}

/** Where attempt() speaks. */
export const objections = () => h("p", { class: "objection", role: "alert" });

/** Files of the folder, each to be opened beside the page; it stays unfolded while they become more. */
export function fileFold(): { node: HTMLElement; show(files: string[]): void } {
  const [head, list] = [h("summary"), h("ul", { class: "files" })];
  const node = h("details", {}, head, list);
  return {
    node,
    show(files) {
      node.hidden = files.length === 0;
      head.textContent = counted(files.length, "file");
      keyed(list, files, () => files.map((f) => h("li", {}, fileLink(f, f))));
    },
  };
}

export const fileLink = (file: string, text: string) => h("a", { href: fileAddress(file), target: "_blank", rel: "noopener" }, text);

/** Makes the content of a place anew where what it shows has changed: what has the focus keeps it. */
export function keyed(place: HTMLElement, shown: unknown, make: () => Child[]) {
  const key = JSON.stringify(shown) ?? "";
  if (place.dataset.shown === key) return;
  place.dataset.shown = key;
  place.replaceChildren(...make().filter((c): c is Node | string => !!c));
}

export interface TextArea {
  node: HTMLTextAreaElement;
  set(text: string): void;
  goTo(line: number): void; // its text selected
  reveal(line: number): void; // at the top of what is seen
}

/** A text area that keeps the caret when its text is set from elsewhere. */
export function textArea(changed: (text: string) => void, attributes: Record<string, string>): TextArea {
  const node = h("textarea", { spellcheck: "false", autocapitalize: "off", autocomplete: "off", wrap: "off", ...attributes });
  node.addEventListener("input", () => changed(node.value));
  return {
    node,
    set(text) {
      if (node.value === text.replaceAll("\r\n", "\n")) return;
      const caret = node.selectionStart;
      node.value = text;
      node.setSelectionRange(caret, caret);
      node.rows = Math.min(22, Math.max(6, text.split("\n").length + 1));
    },
    goTo(line) {
      const before = node.value.split("\n").slice(0, line);
      const from = before.join("\n").length + (line > 0 ? 1 : 0);
      const end = node.value.indexOf("\n", from);
      node.focus();
      node.setSelectionRange(from, end < 0 ? node.value.length : end);
    },
    reveal(line) {
      node.scrollTop = (line * node.scrollHeight) / Math.max(1, node.value.split("\n").length);
    },
  };
}

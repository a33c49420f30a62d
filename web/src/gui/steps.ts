// The way from a table to a tested rock, with the state of each step, always in sight.
import { h } from "../dom";

export type StepState = "waiting" | "running" | "done" | "wrong";

const names = { table: "Table", check: "Check", calibration: "Calibrate", tests: "Test", results: "Results" };
export type Step = keyof typeof names;

export interface Steps {
  items: HTMLElement[];
  /** `words`: the state, for those who see no colours too. */
  show(step: Step, state: StepState, words: string): void;
}

export function steps(): Steps {
  const made = Object.entries(names).map(([id, name], i) => {
    const words = h("small");
    const link = h("a", { href: `#${id}`, class: "step" }, h("b", { "aria-hidden": "true" }, String(i + 1)), h("span", {}, name, words));
    return { id, link, words };
  });
  return {
    items: made.map((m) => h("li", {}, m.link)),
    show(step, state, words) {
      const m = made.find((one) => one.id === step)!;
      m.link.dataset.state = state;
      if (m.words.textContent !== words) m.words.textContent = words;
    },
  };
}

/** Commands and texts of files are for some, and in the way of others: shown where asked for, in all tabs to come. */
export function textSwitch(): HTMLElement {
  const kept = "phyllite commands";
  const button = h("button", { type: "button" }, "Commands and TOML");
  const show = (on: boolean) => {
    document.documentElement.dataset.commands = on ? "shown" : "away";
    button.setAttribute("aria-pressed", String(on));
  };
  button.addEventListener("click", () => {
    const on = document.documentElement.dataset.commands !== "shown";
    localStorage.setItem(kept, String(on));
    show(on);
  });
  show(localStorage.getItem(kept) === "true");
  return button;
}

/** Something in a text is gone to: it has to be seen. */
export const showTexts = () => document.documentElement.dataset.commands === "shown" || document.querySelector<HTMLElement>("#commands button")?.click();

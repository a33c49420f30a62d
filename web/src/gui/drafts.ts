// What has been typed and not saved, kept in the browser until it is: a reload or a closed tab loses nothing, and tabs of one
// rock show the same.
import { Files } from "./server";

export interface Draft extends Files {
  stamp: string; // of the files that it began from
}

const key = (folder: string, rock: string) => `phyllite draft ${folder} ${rock}`;

export function draft(folder: string, rock: string): Draft | null {
  try {
    return JSON.parse(localStorage.getItem(key(folder, rock)) ?? "null") as Draft | null;
  } catch {
    return null;
  }
}

export function keep(folder: string, rock: string, d: Draft | null) {
  try {
    if (d) localStorage.setItem(key(folder, rock), JSON.stringify(d));
    else localStorage.removeItem(key(folder, rock));
  } catch {
    // A browser that keeps nothing: the text is in this tab alone.
  }
}

/** Choices of a form, as they were made last. */
export function chosenBefore<T>(key: string): Partial<T> {
  try {
    return JSON.parse(localStorage.getItem(key) ?? "{}") as Partial<T>;
  } catch {
    return {};
  }
}

export function keepChosen(key: string, choices: unknown) {
  try {
    localStorage.setItem(key, JSON.stringify(choices));
  } catch {
    // A browser that keeps nothing: a reload begins afresh.
  }
}

/** Another tab has changed the draft of a rock; `open` says which one is shown. */
export function onDraft(open: () => [string, string] | null, act: () => void) {
  addEventListener("storage", (e) => {
    const now = open();
    if (now && e.key === key(...now)) act();
  });
}

// How long something has been running: the program says it with every answer, and the page counts on in between.
import { h } from "../dom";

/** Seconds as somebody would say them. */
export function duration(seconds: number): string {
  if (seconds < 90) return `${Math.round(seconds)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

/** "2 to 9 min", "40 s to 3 min". */
export function between(low: number, high: number): string {
  const [from, to] = [duration(low), duration(high)];
  if (from === to) return to;
  const unit = to.slice(to.lastIndexOf(" "));
  return `${from.endsWith(unit) ? from.slice(0, -unit.length) : from} to ${to}`;
}

export interface Clock {
  node: HTMLElement;
  /** `seconds` of what runs; null: it does not run. */
  show(seconds: number | null): void;
}

const running = new Set<() => void>();
setInterval(() => running.forEach((tick) => tick()), 1000);

export function clock(): Clock {
  const node = h("span", { class: "clock" });
  let begun = 0;
  const say = () => (node.textContent = `${duration((performance.now() - begun) / 1000)} so far`);
  const tick = () => (node.isConnected ? say() : running.delete(tick)); // else its rock is open no more
  return {
    node,
    show(seconds) {
      node.hidden = seconds === null;
      if (seconds === null) return void running.delete(tick);
      const from = performance.now() - 1000 * seconds;
      if (!running.has(tick) || Math.abs(from - begun) > 1500) begun = from; // an answer that was late is no reason to jump
      running.add(tick);
      say();
    },
  };
}

/** Moves where nobody knows how much there is to do. */
export function bar(label: string): { node: HTMLProgressElement; show(done: number, total: number): void } {
  const node = h("progress", { "aria-label": label });
  return {
    node,
    show(done, total) {
      if (total <= 0) return node.removeAttribute("value");
      node.max = total;
      node.value = done;
    },
  };
}

// The specimen in the press: it breaks on the page while the program tests it, its curve growing beside it.
import { noCracks } from "../data";
import { h } from "../dom";
import { draw } from "../figure";
import { Press, Pressed, readPress } from "../press";
import { Viewer } from "../viewer";
import { Reach, growing, reached } from "./charts";
import { Figures } from "./figures";
import { ask } from "./server";

const between = 300; // from one picture to the next [ms]
const tallest = 440; // of a specimen [CSS pixels]

export interface LiveView {
  node: HTMLElement;
  /** `address` of what is in the press; null: nothing runs, and the last picture stays. */
  follow(address: string | null): void;
}

const shown = new Set<Picture>();
(window as unknown as { phylliteLive: unknown }).phylliteLive = shown; // for tests: how long a picture takes
const others: (() => void)[] = [];
/** What else draws with the colours of the page. */
export const redrawOnTheme = (act: () => void) => void others.push(act);
export const redrawLive = () => [...shown].map((p) => () => p.recolor()).concat(others).forEach((act) => act());

/** A canvas with one specimen, which moves on from each picture to the next. */
class Picture {
  readonly canvas = h("canvas", { role: "img", "aria-label": "Specimen in the press" });
  private viewer: Viewer | null = null;
  private last: Pressed | null = null;
  private name = "";
  private came = 0;
  private observer = new ResizeObserver(() => this.viewer?.layout());

  show(p: Press) {
    if (!this.viewer) {
      for (const other of shown) if (!other.canvas.isConnected || other.canvas.closest("[data-live=over]")) other.end(); // browsers keep few drawings by WebGL at a time
      this.viewer = new Viewer(this.canvas, [{ cracks: noCracks(), bedding: [], end: 1, load: null }], () => {}, () => innerHeight - tallest, [6, 6], true);
      this.observer.observe(this.canvas);
      shown.add(this);
    }
    const now = readPress(p, this.name === p.specimen ? this.last : null);
    [this.last, this.name, this.came] = [now, p.specimen, performance.now()];
    Object.assign(this.viewer.tests[0], { cracks: now.cracks, bedding: now.bedding });
    this.viewer.put(0, now.scene);
    this.viewer.layout();
    this.move();
  }

  drawNow() {
    this.viewer?.drawNow();
  }

  recolor() {
    this.viewer?.readColors();
    this.viewer?.draw();
  }

  /** Kinds of the cracks that are shown. */
  get kinds(): Uint8Array {
    return this.last?.cracks.kind ?? new Uint8Array();
  }

  private move = () => {
    if (!this.viewer || document.hidden) return;
    // A plain canvas is slow, and would take time from the tests: it draws no pictures in between.
    const part = this.viewer.drawsForces ? Math.min(1, (performance.now() - this.came) / between) : 1;
    this.viewer.show([part]);
    if (part < 1) requestAnimationFrame(this.move);
  };

  private end() {
    this.observer.disconnect();
    this.viewer?.end();
    this.viewer = null;
    shown.delete(this);
    this.canvas.remove();
  }
}

/** Bonds that have broken, by kind. */
function broken(p: Press, now: Uint8Array): HTMLElement {
  const of = (kind: number) => now.reduce((n, k) => n + (k === kind ? 1 : 0), 0);
  return h("ul", { class: "legend" }, ...p.crack_kinds.map((name, kind) => h("li", {}, h("i", { style: `background:var(--crack-${kind})` }), `${name}: ${of(kind)}`)));
}

export function liveView(): LiveView {
  const picture = new Picture();
  const title = h("h3");
  const cracks = h("div");
  const curve = new Figures("curve");
  const reach = new Map<string, Reach>(); // of each kind of test: its axes do not jump from one specimen to the next
  const node = h("div", { class: "live" }, title, h("div", { class: "pair" }, h("div", { class: "specimen" }, picture.canvas), h("div", {}, curve.node, cracks)));
  node.hidden = true;
  let address: string | null = null;
  let round = 0;

  function show(p: Press) {
    node.hidden = false;
    title.textContent = `In the press${p.over ? ", at its end" : ""}: ${p.test.replaceAll("_", " ")}, ${p.specimen.replace("theta", "θ").replace(" deg", "°")}`;
    picture.show(p);
    const pressed = { test: p.test, strain: p.strain, stress: p["stress [Pa]"] };
    const axes = reached(pressed, reach);
    curve.show([{ name: "Stress and strain in the press", shown: [pressed, axes], draw: (width) => draw(growing(pressed, axes), width).node }]);
    cracks.replaceChildren(broken(p, picture.kinds));
  }

  async function look() {
    const mine = ++round;
    while (mine === round && address !== null && node.isConnected) {
      const p = document.hidden ? null : await ask<Press | null>(address).catch(() => null);
      if (mine === round && p !== null) show(p);
      await new Promise((next) => setTimeout(next, between));
    }
  }

  return {
    node,
    follow(next) {
      node.dataset.live = next === null ? "over" : "now";
      if (next === address) return;
      address = next;
      if (next !== null) void look();
    },
  };
}

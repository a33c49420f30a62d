// Specimens on a plain canvas, where the browser has no WebGL 2: the same colours, each disc an arc. Slower, and without contact forces.
import { Scene, lastUpTo } from "./data";
import { Colors, Moment, Painter, Pictured, ViewState, between, ramps, tones } from "./painter";

interface Taken {
  what: Pictured;
  scene: Scene;
  tones: Uint8Array;
}

const steps = 24; // colours of a scale

/** Where a disc is on the scale of the field, 0 … 1. */
function level(field: ViewState["field"], ux: number, uy: number, range: number): number {
  if (field === "magnitude") return Math.hypot(ux, uy) / range;
  return 0.5 + (0.5 * (field === "horizontal" ? ux : uy)) / range;
}

function mixed(colors: string[], part: number): string {
  const at = Math.min(1, Math.max(0, part)) * (colors.length - 1);
  const k = Math.min(colors.length - 2, Math.floor(at));
  const channel = (c: string, i: number) => parseInt(c.slice(1 + 2 * i, 3 + 2 * i), 16);
  return `rgb(${[0, 1, 2].map((i) => Math.round(channel(colors[k], i) + (at - k) * (channel(colors[k + 1], i) - channel(colors[k], i)))).join(",")})`;
}

export class FlatPainter implements Painter {
  colors!: Colors;
  private taken = new Map<number, Taken>();

  constructor(private flat: CanvasRenderingContext2D) {}

  take(number: number, what: Pictured, scene: Scene) {
    this.taken.set(number, { what, scene, tones: tones(scene, what) });
  }

  clear() {
    this.flat.setTransform(1, 0, 0, 1, 0, 0);
    this.flat.clearRect(0, 0, this.flat.canvas.width, this.flat.canvas.height);
  }

  end() {
    this.taken.clear();
  }

  paint(number: number, state: ViewState, now: Moment) {
    const t = this.taken.get(number);
    if (!t) return;
    const { cell, dpr } = now;
    const pixels = dpr / now.metres; // of the canvas per metre
    this.flat.save();
    this.flat.setTransform(1, 0, 0, 1, 0, 0);
    this.flat.beginPath();
    this.flat.rect(cell.left * dpr, cell.top * dpr, cell.width * dpr, cell.height * dpr);
    this.flat.clip();
    const x = (cell.left + cell.width / 2) * dpr - pixels * t.scene.width * (0.5 + state.x);
    const y = (cell.top + cell.height / 2) * dpr + pixels * (t.scene.height * 0.5 + t.scene.width * state.y);
    const places = this.places(t, state, now.strain, pixels, x, y);
    this.discs(t, state, now.range, places, pixels);
    if (state.cracks) this.cracks(t, now.strain, places, pixels, dpr);
    this.flat.restore();
  }

  /** x, y [pixels], u_x, u_y [m] of each disc. */
  private places(t: Taken, state: ViewState, strain: number, pixels: number, x: number, y: number): Float32Array {
    const { before, after, blend } = between(t.scene, strain);
    const [a, b] = [t.scene.frames[before], t.scene.frames[after]];
    const n = t.scene.discs.length / 3;
    const out = new Float32Array(4 * n);
    for (let i = 0; i < n; ++i) {
      const ux = (a[2 * i] + blend * (b[2 * i] - a[2 * i])) * t.scene.quantum;
      const uy = (a[2 * i + 1] + blend * (b[2 * i + 1] - a[2 * i + 1])) * t.scene.quantum;
      out[4 * i] = x + pixels * (t.scene.discs[3 * i] + state.magnify * ux);
      out[4 * i + 1] = y - pixels * (t.scene.discs[3 * i + 1] + state.magnify * uy);
      out[4 * i + 2] = ux;
      out[4 * i + 3] = uy;
    }
    return out;
  }

  /** Discs of one colour are one path. */
  private discs(t: Taken, state: ViewState, range: number, places: Float32Array, pixels: number) {
    const field = state.field;
    const colors = field === "bedding" ? this.colors.tones : Array.from({ length: steps }, (_, k) => mixed(field === "magnitude" ? ramps.magnitude : ramps.signed, k / (steps - 1)));
    const paths = colors.map(() => new Path2D());
    for (let i = 0; i < t.tones.length; ++i) {
      const part = field === "bedding" ? 0 : level(field, places[4 * i + 2], places[4 * i + 3], range);
      const path = paths[field === "bedding" ? t.tones[i] : Math.round(Math.min(1, Math.max(0, part)) * (steps - 1))];
      const [x, y, r] = [places[4 * i], places[4 * i + 1], pixels * t.scene.discs[3 * i + 2]];
      path.moveTo(x + r, y);
      path.arc(x, y, r, 0, 2 * Math.PI);
    }
    paths.forEach((path, k) => {
      this.flat.fillStyle = colors[k];
      this.flat.fill(path);
    });
  }

  private cracks(t: Taken, strain: number, places: Float32Array, pixels: number, dpr: number) {
    const c = t.what.cracks;
    const n = lastUpTo(c.strain, strain) + 1;
    for (let i = 0; i < n; ++i) {
      const [a, b] = [c.a[i], c.b[i]];
      const [ra, rb] = [t.scene.discs[3 * a + 2], t.scene.discs[3 * b + 2]];
      const part = ra / (ra + rb);
      const x = places[4 * a] + part * (places[4 * b] - places[4 * a]);
      const y = places[4 * a + 1] + part * (places[4 * b + 1] - places[4 * a + 1]);
      const half = Math.max(0.62 * c.size[i] * pixels, 1.4 * dpr);
      this.flat.strokeStyle = this.colors.kinds[c.kind[i]];
      this.flat.lineWidth = Math.max(0.26 * c.size[i] * pixels, 1.5 * dpr);
      this.flat.beginPath();
      this.flat.moveTo(x + half * c.normal_y[i], y + half * c.normal_x[i]);
      this.flat.lineTo(x - half * c.normal_y[i], y - half * c.normal_x[i]);
      this.flat.stroke();
    }
  }
}

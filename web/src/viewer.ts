// The specimens of a page: one canvas, a cell per specimen, drawn by WebGL 2 or, where the browser has none, plainly.
import { Scene } from "./data";
import { Cell, Painter, Pictured, ViewState, colorsNow } from "./painter";
import { FlatPainter } from "./painter_flat";
import { GlPainter } from "./painter_gl";

export const headHeight = 24; // above a specimen: its name [CSS pixels]
const footHeight = 62; // below: strength, that of a table, stress and cracks
const paperFootHeight = 34; // on paper nothing moves: its strength, and that of a table
const leastHeight = 200; // of one specimen; on paper the most, so that page one has room for them

function percentile(values: Float32Array, part: number): number {
  values.sort();
  return values[Math.floor(part * (values.length - 1))] || 0;
}

function ranges(scene: Scene): [number, number, number] {
  const last = scene.frames[scene.frames.length - 1];
  const n = last.length / 2;
  const all = [0, 1, 2].map(() => new Float32Array(n));
  for (let i = 0; i < n; ++i) {
    const [x, y] = [last[2 * i] * scene.quantum, last[2 * i + 1] * scene.quantum];
    all[0][i] = Math.hypot(x, y);
    all[1][i] = Math.abs(x);
    all[2][i] = Math.abs(y);
  }
  return [percentile(all[0], 0.98), percentile(all[1], 0.98), percentile(all[2], 0.98)];
}

/** What can be shown: a specimen, its scene where there is one, and the strain at its end. */
export interface Shown extends Pictured {
  end: number;
  load: (() => Promise<Scene>) | null;
}

interface Loaded {
  scene: Scene;
  range: [number, number, number]; // 98th percentile of |u|, |u_x|, |u_y| at the end [m]
}

/** Whether WebGL is computed without a graphics processor. */
function inSoftware(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) return false;
  const named = probe.getExtension("WEBGL_debug_renderer_info");
  const renderer = String(probe.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : probe.RENDERER));
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
}

/** `soon`: a plain canvas also in place of WebGL without a graphics processor, which takes three times as long. */
function painterOn(canvas: HTMLCanvasElement, soon: boolean): Painter {
  const gl = soon && inSoftware() ? null : canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
  if (gl) return new GlPainter(gl);
  const flat = canvas.getContext("2d");
  if (!flat) throw new Error("this browser draws on no canvas");
  return new FlatPainter(flat);
}

export class Viewer {
  readonly state: ViewState = { field: "bedding", forces: false, cracks: true, magnify: 1, zoom: 1, x: 0, y: 0, only: null };
  cells: Cell[] = [];
  height = 0; // of the canvas [CSS pixels]
  paper = false; // the sheet is narrower than most screens, and printers are sharper
  scriptTime: number[] = []; // milliseconds of the last frames
  private loaded: (Loaded | null)[];
  private unreadable = new Set<number>();
  private painter: Painter;
  private strains: number[];
  private queued = false;

  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly tests: Shown[],
    private onLayout: () => void,
    private besides: () => number, // height of what is to be seen together with one specimen [CSS pixels]
    private rims: [number, number] = [headHeight, footHeight], // above and below a specimen
    soon = false,
  ) {
    this.painter = painterOn(canvas, soon);
    this.loaded = tests.map(() => null);
    this.strains = tests.map((t) => t.end);
    this.readColors();
  }

  /** Contact forces are drawn by WebGL alone. */
  get drawsForces() {
    return this.painter instanceof GlPainter;
  }

  async load(): Promise<void> {
    for (let i = 0; i < this.tests.length; ++i) {
      const load = this.tests[i].load;
      if (!load) continue;
      try {
        this.put(i, await load());
      } catch (error) {
        this.unreadable.add(i); // the numbers of the specimen stand
      }
      this.layout();
      await new Promise((done) => setTimeout(done));
    }
  }

  /** A scene takes the place of the one that the specimen had. */
  put(test: number, scene: Scene) {
    this.painter.take(test, this.tests[test], scene);
    this.loaded[test] = { scene, range: ranges(scene) };
  }

  /** Draws no more. */
  end() {
    this.painter.end();
  }

  /** Why a specimen is not seen; "": it is. */
  absent(test: number): string {
    if (this.loaded[test]) return "";
    return !this.tests[test].load ? "no picture stored" : this.unreadable.has(test) ? "cannot be read" : "loading …";
  }

  /** Axial strain at which each specimen is shown. */
  show(strains: number[]) {
    this.strains = strains;
    this.draw();
  }

  readColors() {
    this.painter.colors = colorsNow();
  }

  /** Divides the canvas into cells: as many columns as keep a specimen readable. */
  layout() {
    const [head, foot] = this.paper ? [headHeight, paperFootHeight] : this.rims;
    const shown = this.state.only === null ? this.tests.map((_, i) => i) : [this.state.only];
    const width = this.canvas.clientWidth;
    const first = this.loaded.find((l) => l !== null);
    const aspect = first ? first.scene.height / first.scene.width : 2;
    const least = this.paper || width < 520 ? 80 : 130;
    const columns = Math.max(1, Math.min(shown.length, Math.floor(width / least)));
    const lines = Math.ceil(shown.length / columns);
    const even = Math.ceil(shown.length / lines);
    const cellWidth = width / even;
    const limit = this.paper ? leastHeight : shown.length === 1 ? Math.max(leastHeight, window.innerHeight - head - foot - this.besides()) : 620;
    const cellHeight = Math.min(limit, cellWidth * aspect);
    this.cells = shown.map((test, k) => ({
      test,
      left: (k % even) * cellWidth,
      top: Math.floor(k / even) * (cellHeight + head + foot) + head,
      width: cellWidth,
      height: cellHeight,
    }));
    const height = lines * (cellHeight + head + foot);
    this.height = height;
    this.canvas.style.aspectRatio = `${width} / ${height}`; // kept on paper, which is of another width
    const dpr = this.paper ? 3 : Math.min(2, window.devicePixelRatio || 1);
    const [w, h] = [Math.round(width * dpr), Math.round(height * dpr)];
    if (this.canvas.width !== w) this.canvas.width = w;
    if (this.canvas.height !== h) this.canvas.height = h;
    this.onLayout();
    this.draw();
  }

  /** Draws with the next frame of the browser. */
  draw() {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => {
      this.queued = false;
      this.drawNow();
    });
  }

  /** The largest value on the colour scale [m], common to all specimens. */
  range(): number {
    const k = { bedding: 0, magnitude: 0, horizontal: 1, vertical: 2 }[this.state.field];
    return Math.max(1e-9, ...this.loaded.map((l) => (l ? l.range[k] : 0)));
  }

  /** Metres per CSS pixel in a cell. */
  metresPerPixel(cell: Cell): number {
    const l = this.loaded[cell.test];
    if (!l) return 1;
    return Math.max(l.scene.width / cell.width, l.scene.height / cell.height) * (1.08 / this.state.zoom);
  }

  /** Moves the view along with a pointer [CSS pixels]. */
  pan(dx: number, dy: number) {
    const cell = this.cells.find((c) => this.loaded[c.test] !== null);
    if (!cell) return;
    const part = this.metresPerPixel(cell) / this.loaded[cell.test]!.scene.width;
    this.state.x -= dx * part;
    this.state.y += dy * part;
    this.draw();
  }

  drawNow() {
    const start = performance.now();
    this.painter.clear();
    const dpr = this.canvas.width / Math.max(1, this.canvas.clientWidth);
    const range = this.range();
    for (const cell of this.cells) this.painter.paint(cell.test, this.state, { strain: this.strains[cell.test], cell, metres: this.metresPerPixel(cell), dpr, range });
    this.scriptTime.push(performance.now() - start);
    if (this.scriptTime.length > 120) this.scriptTime.shift();
  }
}

// What draws specimens: given a specimen once, then told again and again at which strain and where. There are two, one by WebGL 2
// (painter_gl.ts) and one on a plain canvas (painter_flat.ts).
import { Cracks, Scene, lastUpTo } from "./data";

export type Field = "bedding" | "magnitude" | "horizontal" | "vertical";

export interface ViewState {
  field: Field;
  forces: boolean;
  cracks: boolean;
  magnify: number; // of displacements
  zoom: number;
  x: number; // of the view's centre, in widths of the specimen from its centre
  y: number;
  only: number | null; // the one specimen shown, or all
}

/** What of a specimen is drawn beside its discs. */
export interface Pictured {
  cracks: Cracks;
  bedding: { theta: number; spacing: number; offset: number }[];
}

export interface Cell {
  test: number;
  left: number;
  top: number;
  width: number;
  height: number; // CSS pixels within the canvas
}

/** One specimen at one moment, in its cell. */
export interface Moment {
  strain: number;
  cell: Cell;
  metres: number; // per CSS pixel
  dpr: number; // pixels of the canvas per CSS pixel
  range: number; // the largest value on the colour scale [m]
}

export interface Painter {
  colors: Colors;
  /** Takes the place of what the specimen of this number was. */
  take(number: number, what: Pictured, scene: Scene): void;
  clear(): void;
  paint(number: number, state: ViewState, now: Moment): void;
  /** Gives back what it holds of the machine. */
  end(): void;
}

/** Colour scales of displacements from 0, and of signed ones. */
export const ramps = {
  magnitude: ["#30123b", "#3e7ef7", "#1bcfb0", "#c7ee3d", "#f3a32e"],
  signed: ["#2166ac", "#92c5de", "#f2f2f0", "#f4a582", "#b2182b"],
};

/** As CSS has them now: #rrggbb. */
export interface Colors {
  tones: string[];
  push: string;
  pull: string;
  kinds: string[]; // of cracks
}

export function colorsNow(): Colors {
  const style = getComputedStyle(document.documentElement);
  const get = (name: string) => style.getPropertyValue(name).trim();
  return { tones: [0, 1, 2].map((k) => get(`--grain-${k}`)), push: get("--push"), pull: get("--pull"), kinds: [0, 1, 2, 3].map((k) => get(`--crack-${k}`)) };
}

/** The two frames beside a strain, and how far it is from one to the other. */
export function between(scene: Scene, strain: number): { before: number; after: number; blend: number } {
  const before = Math.max(0, lastUpTo(scene.strains, strain));
  const after = Math.min(before + 1, scene.strains.length - 1);
  const span = scene.strains[after] - scene.strains[before];
  return { before, after, blend: span > 0 ? Math.min(1, Math.max(0, (strain - scene.strains[before]) / span)) : 0 };
}

/** Which tone a disc has: 0 and 1 alternate between bedding planes, 2 carries a joint. */
export function tones(scene: Scene, what: Pictured): Uint8Array {
  const n = scene.discs.length / 3;
  const out = new Uint8Array(n);
  const set = what.bedding[0];
  if (set) {
    const angle = (set.theta * Math.PI) / 180;
    const [nx, ny] = [-Math.sin(angle), Math.cos(angle)];
    for (let i = 0; i < n; ++i) {
      const along =
        nx * (scene.discs[3 * i] - scene.width / 2) + ny * (scene.discs[3 * i + 1] - scene.height / 2) - set.offset;
      out[i] = Math.abs(Math.floor(along / set.spacing)) % 2;
    }
  }
  scene.jointed.forEach((joint, i) => joint && (out[i] = 2));
  return out;
}

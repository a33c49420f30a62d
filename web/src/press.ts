// The specimen in the press as the program leaves it in a file while it tests (docs/formats.md, "Press").
import { Scene, bytes, u32 } from "./data";
import { Pictured } from "./painter";

export interface Press {
  specimen: string;
  test: string;
  "width [m]": number;
  "height [m]": number;
  bedding: Pictured["bedding"];
  crack_kinds: string[];
  "disc_quantum [m]": number;
  discs: string;
  jointed: string;
  over: boolean; // the specimen as it ended
  strain: number[];
  "stress [Pa]": number[];
  "displacement_quantum [m]": number;
  moves: string;
  cracks: { pairs: string; shapes: string; kinds: string };
}

const i16 = (text: string) => new Int16Array(bytes(text).buffer as ArrayBuffer);

/** A specimen at two moments: 0 before, 1 now. */
export interface Pressed extends Pictured {
  scene: Scene;
}

/** In quanta of another size. */
const requantized = (frame: Int16Array, factor: number) => (factor === 1 ? frame : frame.map((v) => Math.round(v * factor)));

/** `before`: the same specimen a moment ago, or nothing. */
export function readPress(p: Press, before: Pressed | null): Pressed {
  const quantum = p["disc_quantum [m]"];
  const [width, height] = [p["width [m]"], p["height [m]"]];
  const raw = i16(p.discs);
  const discs = new Float32Array(raw.length);
  const origin = [width / 2, height / 2, 0];
  for (let i = 0; i < raw.length; ++i) discs[i] = origin[i % 3] + quantum * raw[i];
  const now = i16(p.moves);
  const scale = p["displacement_quantum [m]"];
  const old = before && before.scene.frames[1].length === now.length ? requantized(before.scene.frames[1], before.scene.quantum / scale) : now;
  const [pairs, shapes] = [u32(p.cracks.pairs), i16(p.cracks.shapes)];
  const n = pairs.length / 2;
  const cracks = { strain: new Float64Array(n), a: new Uint32Array(n), b: new Uint32Array(n), kind: bytes(p.cracks.kinds), normal_x: new Float32Array(n), normal_y: new Float32Array(n), size: new Float32Array(n) };
  for (let i = 0; i < n; ++i) {
    [cracks.a[i], cracks.b[i]] = [pairs[2 * i], pairs[2 * i + 1]];
    [cracks.normal_x[i], cracks.normal_y[i], cracks.size[i]] = [shapes[3 * i] / 32767, shapes[3 * i + 1] / 32767, shapes[3 * i + 2] * quantum];
  }
  const scene = { width, height, discs, quantum: scale, strains: [0, 1], frames: [old, now], jointed: bytes(p.jointed), links: new Uint32Array(0), forceStrains: [], forceMax: [], forces: new Int8Array(0) };
  return { scene, cracks, bedding: p.bedding };
}

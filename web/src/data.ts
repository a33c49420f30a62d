// What report.html carries: one block of JSON (the results and their figures) and one scene per specimen.
// src/report/page.cpp writes it; docs/formats.md describes scenes.
import { Figure, Series, colorOf } from "./figure";

export interface NumberValue {
  value: number | null;
  unit: string;
  definition: string;
  note?: string;
  upper_bound?: boolean; // the value is one
}

/** calibration.json as `phyllite calibrate` writes it (docs/formats.md). */
export interface Estimate {
  key: string;
  symbol: string;
  unit: string;
  value: number | null;
  low: number | null;
  high: number | null;
  box: [number, number]; // values that the calibration admits
  determined: boolean | null; // null: the method gives no intervals
  rests_on?: { text: string };
  next?: { text: string };
}

export interface Comparison {
  property: string;
  "theta [deg]": number;
  laboratory: { mean: number; sd: number; n: number; specimens?: number[] };
  model: number | null;
  sd_of_packings: number | null;
  failure?: Failure; // of a strength that was tested
  n_packings: number;
  low: number | null;
  high: number | null;
  "diameter [m]"?: number; // of a disc
  "confining [Pa]"?: number;
  with_discrepancy?: number | null; // of strengths: the model with what it misses of the table
}

/** Values left out of a property, beside the best curve: its key among those of a row, null where none could be fitted. */
export interface Yardstick {
  property: string;
  best: string | null;
  text: string;
}

/** A measured property as people read it. */
export interface Property {
  axis: string;
  unit: string;
  factor: number; // from SI
}

/** How the model's specimens fail, over packings; null: no bedding, or cracks that do not line up. */
export interface Failure {
  bedding_share: number | null;
  bedding_share_sd: number | null;
  "angle [deg]": number | null;
  "angle_sd [deg]": number | null;
  n_tests: number;
  n_planes: number; // tests whose cracks line up
}

/** What was found: its kind and what belongs to it are data, the text is for people. */
export interface Finding {
  kind: string;
  text: string;
}

export interface Calibration {
  rock: string;
  method?: "sequence"; // none: a posterior
  verdict: { status: string; sentence: string; lines: string[]; findings: Finding[] };
  tables?: { title: string; head: string; rows: [string, string][] }[]; // parameters in words; not in older files
  errors?: ({ of: string } & Record<string, number | string>)[]; // root mean squares
  runs?: { strength_tests: number; of_these_in_tension: number; elastic_solutions: number };
  parameters: Estimate[];
  fitted: Comparison[];
  verification: Comparison[];
  left_out: Comparison[];
  yardsticks?: Yardstick[];
  compared?: Comparison[]; // not fitted, without part in the verdict
  tangent_from_test?: Comparison[]; // E and nu at half of UCS; not in older files
  eq2?: { planes: string; K_n: Line; K_s: Line }[]; // macro over micro stiffness; none where Eq. 1 is not of the model
  notes: Finding[];
}

/** The sheet of a design: constants for other codes (src/design/sheet.cpp). */
export interface Design {
  tables: { title: string; head: string[]; rows: string[][] }[];
  findings: Finding[];
  figure: Figure;
}

/** K over k, and the line K = slope k + intercept [Pa/m]; null: not determined. */
export interface Line {
  ratio: number | null;
  slope: number | null;
  intercept: number | null;
  R2: number | null;
}

/** What speaks against a test (result.json, "quality"). */
export interface Quality {
  grade: string; // good, warning, untrusted
  marks: { number: string; value: number; limit: number; least: boolean; grade: string; says: string; meaning: string; advice: string; of?: string[] }[];
}

export interface RawTest {
  result: {
    specimen: string;
    "theta [deg]"?: number;
    outcome: { status: string; reason: string; advice: string };
    quality: Quality;
    numbers: Record<string, NumberValue>;
    packing: Record<string, unknown>;
    run: Record<string, number>;
    result_hash: string;
  };
  label: string;
  end: number;
  cracks: Record<string, string>;
  bedding: { theta: number; spacing: number; offset: number }[];
  scene: string | null;
}

/** What the curve of a test is (TestCurve, src/records/test_description.hpp). */
export interface Axes {
  strain: string;
  strain_unit: string;
  strain_factor: number; // from the recorded value
  stress: string;
  sign: number; // of recorded strains of scenes
}

/** A number of the results in the table of a test. */
export interface Column {
  head: string;
  unit: string;
  number: string;
  scale: number; // from SI
  digits: number;
  made_for: boolean; // what the test is made for
}

/** null, and of a report without specimens what is of these: nothing to draw. */
export interface Figures {
  calibration: Figure | null;
  study: { macro: Figure; parameters: { key: string; figure: Figure }[] } | null;
  stress_strain: Figure | null;
  damage: Figure;
  anisotropy: Figure;
  modes: Figure;
  rose: Figure;
  events: Figure; // acoustic; no panels where the recipe does not ask for them
  event_places: Figure;
  opening: Figure; // no panels where nothing was excavated
}

interface RawReport {
  name: string;
  program: string;
  head: [string, string][]; // of the first page, name and text: "author", "NN"
  axes: Axes;
  columns: Column[];
  done: { kind: string; kept: string | null; stress: number }; // test, and the stress [Pa] that it keeps, by its key
  tests: RawTest[];
  missing: { name: string; reason: string }[];
  properties: Record<string, Property>; // by name, in the order of tables
  calibration: Calibration | null;
  figures: Figures;
  effects: string[][]; // effects.csv of a study, header first; empty: none
  design: Design | null;
  methods: string[];
  recipe: string;
}

export interface Cracks {
  strain: Float64Array;
  a: Uint32Array;
  b: Uint32Array;
  kind: Uint8Array; // 0 tension matrix, 1 shear matrix, 2 tension bedding, 3 shear bedding
  normal_x: Float32Array;
  normal_y: Float32Array;
  size: Float32Array;
}

export interface Test {
  name: string;
  label: string; // "30°", "intact"
  theta: number | null;
  outcome: { status: string; reason: string; advice: string };
  quality: Quality;
  numbers: Record<string, NumberValue>;
  result: RawTest["result"];
  curve: Series | null; // stress over strain in the units of the axes; null: it was not loaded
  cracks: Cracks;
  bedding: RawTest["bedding"];
  color: string;
  scene: string | null;
  end: number; // strain of the last row, growing as the test loads
}

export interface Report extends Omit<RawReport, "tests"> {
  tests: Test[];
}

export function bytes(base64: string): Uint8Array {
  const known = Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array };
  if (known.fromBase64) return known.fromBase64(base64);
  const text = atob(base64);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out;
}

export const f64 = (s: string) => new Float64Array(bytes(s).buffer as ArrayBuffer);
export const f32 = (s: string) => new Float32Array(bytes(s).buffer as ArrayBuffer);
export const u32 = (s: string) => new Uint32Array(bytes(s).buffer as ArrayBuffer);

export const noCracks = (): Cracks => ({ strain: new Float64Array(), a: new Uint32Array(), b: new Uint32Array(), kind: new Uint8Array(), normal_x: new Float32Array(), normal_y: new Float32Array(), size: new Float32Array() });

/** As src/report/page.cpp packs them. */
export const cracksOf = (c: Record<string, string>): Cracks => ({ strain: f64(c.strain), a: u32(c.a), b: u32(c.b), kind: bytes(c.kind), normal_x: f32(c.normal_x), normal_y: f32(c.normal_y), size: f32(c.size) });

export function readReport(): Report {
  const raw = JSON.parse(document.getElementById("report-data")!.textContent!) as RawReport;
  const curves = raw.figures.stress_strain?.panels[0].series.filter((s) => s.mark === "line") ?? [];
  const tests = raw.tests.map((t, i): Test => {
    const curve = curves.find((s) => s.item === i) ?? null;
    return {
      name: t.result.specimen,
      label: t.label,
      theta: t.result["theta [deg]"] ?? null,
      outcome: t.result.outcome,
      quality: t.result.quality,
      numbers: t.result.numbers,
      result: t.result,
      curve,
      cracks: cracksOf(t.cracks),
      bedding: t.bedding,
      color: curve ? colorOf(curve) : "var(--intact)",
      scene: t.scene,
      end: t.end,
    };
  });
  return { ...raw, tests };
}

/** Index of the last entry that is <= value, or -1; the array ascends. */
export function lastUpTo(values: ArrayLike<number>, value: number): number {
  let low = 0;
  let high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

export interface Scene {
  width: number;
  height: number;
  discs: Float32Array; // x, y, r of each disc [m]
  quantum: number; // of displacements [m]
  strains: number[];
  frames: Int16Array[]; // u_x, u_y of each disc in quanta
  jointed: Uint8Array; // 1: the disc carries a joint
  links: Uint32Array; // a, b of each link
  forceStrains: number[];
  forceMax: number[];
  forces: Int8Array; // all fields, one after the other
}

/** Filed under a strain; of direct shear under a displacement. */
interface Moment {
  axial_strain?: number;
  "shear_displacement [m]"?: number;
}

const filedUnder = (m: Moment) => m.axial_strain ?? m["shear_displacement [m]"] ?? 0;

interface SceneHead {
  "width [m]": number;
  "height [m]": number;
  n_discs: number;
  n_links: number;
  "disc_quantum [m]": number;
  "displacement_quantum [m]": number;
  frames: Moment[];
  forces: (Moment & { "F_max [N/m]": number })[];
  sections: [number, number][];
}

async function inflate(packed: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([packed as BlobPart]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Reads the sections of a scene one after the other. */
function sections(head: SceneHead, plain: Uint8Array) {
  let at = 0;
  let section = 0;
  return (): Int32Array => {
    const [count, planes] = head.sections[section++];
    const out = new Int32Array(count);
    for (let p = 0; p < planes; ++p, at += count)
      for (let i = 0; i < count; ++i) out[i] |= plain[at + i] << (8 * p);
    for (let i = 0; i < count; ++i) out[i] = (out[i] >>> 1) ^ -(out[i] & 1);
    return out;
  };
}

/** `packed`: in base 64. */
export async function readScene(packed: string, sign: number): Promise<Scene> {
  const all = bytes(packed.trim());
  const end = all.indexOf(10);
  const head = JSON.parse(new TextDecoder().decode(all.subarray(0, end))) as SceneHead;
  const next = sections(head, await inflate(all.subarray(end + 1)));
  const n = head.n_discs;
  const discs = new Float32Array(3 * n);
  for (let k = 0; k < 3; ++k) next().forEach((v, i) => (discs[3 * i + k] = v * head["disc_quantum [m]"]));
  const now = new Int32Array(2 * n);
  const change = new Int32Array(2 * n);
  const frames = head.frames.map(() => {
    const second = next();
    const frame = new Int16Array(2 * n);
    for (let i = 0; i < 2 * n; ++i) {
      change[i] += second[i];
      now[i] += change[i];
      frame[i < n ? 2 * i : 2 * (i - n) + 1] = now[i];
    }
    return frame;
  });
  const [a, b, kind] = [next(), next(), next()];
  const links = new Uint32Array(2 * head.n_links);
  for (let i = 0, last = 0; i < head.n_links; ++i) {
    last += a[i];
    links[2 * i] = last;
    links[2 * i + 1] = last + b[i];
  }
  const jointed = new Uint8Array(n);
  kind.forEach((k, i) => {
    if (k === 2) jointed[links[2 * i]] = jointed[links[2 * i + 1]] = 1;
  });
  const forces = new Int8Array(head.n_links * head.forces.length);
  head.forces.forEach((_, k) => forces.set(next(), k * head.n_links));
  return {
    width: head["width [m]"],
    height: head["height [m]"],
    discs,
    quantum: head["displacement_quantum [m]"],
    strains: head.frames.map((f) => sign * filedUnder(f)),
    frames,
    jointed,
    links,
    forceStrains: head.forces.map((f) => sign * filedUnder(f)),
    forceMax: head.forces.map((f) => f["F_max [N/m]"]),
    forces,
  };
}

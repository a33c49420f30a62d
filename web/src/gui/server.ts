// What the page asks the program, and what it answers: JSON (src/gui/api.cpp).
import { Figure } from "../figure";

export type State = "new" | "running" | "stopped" | "finished" | "failed";

export interface Key {
  path: string; // "test.confining_stress"
  meaning: string;
  range: string;
  unit?: string; // of a number without one
  kind: "quantity" | "number" | "integer" | "boolean" | "choice" | "text" | "list";
  choices: string[];
  tests?: string[]; // kinds that alone read it; none: all do
}

/** What a calibration may be asked for. */
export interface Option extends Key {
  word: string; // "--max-tests"
  title: string; // of its control
  on_page: boolean; // else the page decides by itself
  default: string | number | boolean;
  least: number; // of a whole number
  most: number;
}

export interface Project {
  version: string;
  folder: string;
  threads: number;
  file_token: string; // in the addresses of files
  choices: Record<"E_is" | "layers" | "matrix", string[]>; // the first is the default
  columns: (string | [string, string])[]; // names that a table may have, some with a word on them
  rocks: { name: string; state: State; verdict: string | null }[];
  kinds: { name: string; title: string; kept_stress?: string }[]; // path of the stress that the test keeps
  keys: Key[];
  options: Option[];
  measured: string[]; // rocks that come with the program
}

/** The two files of a rock. */
export interface Files {
  table: string | null; // null: no text, e.g. a workbook
  toml: string;
}

export interface Step {
  value: number;
  low: number | null; // null: not known yet
  high: number | null;
}

export interface Narrowing {
  symbol: string;
  unit: string;
  box: [number, number];
  steps: Step[]; // of the search
}

export interface Progress {
  state: string;
  stage: string;
  seconds: number;
  n_done: number;
  n_total: number;
  model: [number, number]; // which of at most how many; 0: they are compared
  stages: [number, number, number]; // which, of how many at least and at most
  seconds_left: [number, number] | null; // a range
  said: string[];
  parameters: Narrowing[];
}

export interface Run {
  state: State;
  command: string;
  log: string;
  exit_code: number | null;
  seconds: number | null; // that it has been running; null: it does not
  files: string[];
}

export interface Calibrating extends Run {
  folder: string;
  next: string; // the folder that "Calibrate anew" writes into
  here: boolean; // started by this program
  resumes: boolean; // there is something to go on with
  progress: Progress | null;
  verdict: { status: string; sentence: string; lines: string[]; findings: { text: string }[] } | null;
}

/** One calibration of a rock among others. */
export interface Brief {
  folder: string;
  state: State;
  verdict: { status: string | null };
  errors: ({ of: string } & Record<string, number | string>)[]; // root mean squares
  effort: string | null;
  tested: boolean; // it has left a model that can be tested
  began: number; // seconds ago
}

/** A specimen of a test. */
export interface Tested {
  specimen: string;
  theta: number | null;
  status: string;
  strength?: string;
  value?: number | null;
  unit?: string | null;
  grade?: "good" | "warning" | "untrusted";
  notes?: string[];
}

export interface RockTest extends Run {
  name: string;
  specimens: Tested[];
}

export interface RockAnswer extends Files {
  name: string;
  table_file: string;
  stamp: string; // of both files as they lie on disk
  exists: boolean; // else they are what the program would begin with
  calibration: Calibrating; // the one that is open
  calibrations: Brief[]; // all, the newest first
  tests: RockTest[];
}

export interface Problem {
  where: "table" | "rock";
  line: number | null;
  column: number | null; // cell in that line, from 0
  text: string;
}

export interface Target {
  property: string;
  title: string; // with its unit, size and stress
  factor: number; // from SI to that unit
  theta: number;
  mean: number;
  sd: number | null;
  sd_assumed?: boolean; // one specimen alone
  n: number;
  low: number; // 95 % of the mean
  high: number;
  unit: string;
  specimens: number[];
  confining?: number; // [Pa]
  diameter?: number; // [m] of a disc
}

/** What is found, as data; the text is for people. */
export interface Finding {
  kind: string;
  cells: { property: string; "theta [deg]": number | null }[];
  numbers: Record<string, number | number[]>;
  text: string;
}

export interface Checked {
  problems: Problem[];
  bedded: boolean | null; // null: with problems
  doubts: Finding[];
  notes: string[];
  targets: Target[] | null;
  figure: Figure | null; // of the targets
  statements: Finding[];
  parameters: { symbol: string; determined: boolean; interval: string | null; rests_on: { text: string } | null; next: { text: string } | null }[] | null;
  models: string[];
  limits: Finding[];
  in_maps: string[];
  summary: Finding[]; // ten lines of all
  forecast: Finding[];
  grains: { number: number; "diameter [m]": number } | null; // of the model, by the first of those that may be tried
  course: (Finding & { effort: string; numbers: Record<"least_tests" | "most_tests" | "least_seconds" | "most_seconds", number> })[]; // of a calibration, by its effort
}

/** A rock without layers: nothing of it is said over an angle. */
export const isUnbedded = (checked: Checked) => checked.bedded === false;

/** The program has said no; its words are for the user. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    readonly body: { error?: string } & Partial<Files> & { stamp?: string },
  ) {
    super(body.error ?? `the program answered with status ${status}`);
  }
}

/** Nobody answers. */
export class Gone extends Error {
  constructor() {
    super("the program does not answer");
  }
}

const token = new URLSearchParams(location.search).get("token") ?? "";

let connected: (answers: boolean) => void = () => {};
export const onConnection = (tell: (answers: boolean) => void) => (connected = tell);

/** GET without a body, else POST. Throws Refused or Gone. */
export const ask = <T>(path: string, body?: unknown) => (body === undefined ? request<T>(path, "GET") : request<T>(path, "POST", JSON.stringify(body), "application/json"));

/** A file as it is. Throws the same. */
export const upload = <T>(path: string, file: File) => request<T>(path, "POST", file, "application/octet-stream");

/** Where the program runs in this page, without a server (packaging/browser/page.js). */
const inside = (globalThis as { phyllite?: { answer(method: string, path: string, body?: string | File): Promise<{ status: number; body: Uint8Array }> } }).phyllite;

async function request<T>(path: string, method: string, body?: string | File, type?: string): Promise<T> {
  if (inside) {
    const { status, body: bytes } = await inside.answer(method, path, body);
    const content = JSON.parse(new TextDecoder().decode(bytes)) as T;
    if (status !== 200) throw new Refused(status, content as Refused["body"]);
    return content;
  }
  const headers: Record<string, string> = { "X-Phyllite-Token": token, ...(type ? { "Content-Type": type } : {}) };
  let answer: Response;
  let content: unknown;
  try {
    answer = await fetch(path, { method, headers, body, cache: "no-store", signal: AbortSignal.timeout(30000) });
    content = await answer.json().catch(() => ({}));
  } catch {
    connected(false);
    throw new Gone();
  }
  connected(true);
  if (!answer.ok) throw new Refused(answer.status, content as Refused["body"]);
  return content as T;
}

let fileToken = ""; // it opens files and nothing else: an address with it may be seen by a report

export async function askProject(): Promise<Project> {
  const project = await ask<Project>("/api/project");
  fileToken = project.file_token;
  return project;
}

/** Address of a file of the folder. */
export function fileAddress(path: string): string {
  const plain = `/files/${path.split("/").map(encodeURIComponent).join("/")}`;
  return inside ? `#${plain}` : `${plain}?token=${encodeURIComponent(fileToken)}`;
}

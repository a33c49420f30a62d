// A table's text as lines and cells. The text is the master: an edit changes the cells meant and leaves every other character.
// Lines and cells are counted from 0. How a table is split is said in src/io/table.hpp.

export type Separator = "," | ";" | "\t";

export interface Line {
  kind: "header" | "row" | "note"; // note: a comment, a title above the header
  raw: string; // without line end
  cells: string[]; // of a note: none
}

export interface Sheet {
  lines: Line[];
  separator: Separator;
  header: number; // its line; where a blank table will have it
  columns: number;
}

/** Where cells of a line begin and end, quotes and blanks included. */
function split(raw: string, separator: Separator): string[] {
  const cells: string[] = [];
  let quoted = false;
  let from = 0;
  for (let i = 0; i < raw.length; ++i) {
    if (raw[i] === '"') quoted = !quoted;
    if (raw[i] !== separator || quoted) continue;
    cells.push(raw.slice(from, i));
    from = i + 1;
  }
  return [...cells, raw.slice(from)];
}

function plain(cell: string): string {
  const text = cell.trim();
  return text === '""' ? "" : text.replace(/"("?)/g, "$1").trim();
}

function encoded(value: string, separator: Separator): string {
  const line = value.replace(/[\r\n]+/g, " ");
  return line.includes(separator) || line.includes('"') ? `"${line.replaceAll('"', '""')}"` : line;
}

export const isCommaNumber = (cell: string) => /^[+-]?\d+,\d+(e[+-]?\d+)?$/i.test(cell.trim());
const separators = (raw: string) => (raw.match(/[,;\t]/g) ?? []).length;
const isBlank = (raw: string) => raw.trim() === "";
const isComment = (raw: string) => raw.trimStart().startsWith("#");

function isAboveHeader(raw: string, rest: string[]): boolean {
  const next = rest.find((r) => !isBlank(r)) ?? "";
  return /^sep=.$/.test(raw.trim()) || (separators(raw) === 0 && separators(next) >= 2);
}

function headerLine(raws: string[]): number {
  const found = raws.findIndex((raw, i) => !isBlank(raw) && !isComment(raw) && !isAboveHeader(raw, raws.slice(i + 1)));
  if (found >= 0) return found;
  return isBlank(raws[raws.length - 1]) ? raws.length - 1 : raws.length;
}

function separatorOf(header: string): Separator {
  const outside = header.replace(/"[^"]*"/g, "");
  return (["\t", ";", ","] as const).find((s) => outside.includes(s)) ?? ",";
}

const ended = (text: string) => text.split("\n").map((l) => ({ raw: l.replace(/\r$/, ""), end: l.endsWith("\r") ? "\r" : "" }));

export function read(text: string): Sheet {
  const raws = ended(text).map((l) => l.raw);
  const header = headerLine(raws);
  const separator = separatorOf(raws[header] ?? "");
  const lines = raws.map((raw, i): Line => {
    if (isComment(raw) || i < header) return { kind: "note", raw, cells: [] };
    return { kind: i === header ? "header" : "row", raw, cells: split(raw, separator).map(plain) };
  });
  if (isBlank(raws[raws.length - 1]) && header < lines.length - 1) lines.pop(); // what follows the last line break
  return { lines, separator, header, columns: Math.max(1, ...lines.map((l) => l.cells.length)) };
}

/** Raw lines of a text that can be changed, and how they become a text again. */
function opened(text: string) {
  const lines = ended(text);
  const end = text.includes("\r\n") ? "\r" : "";
  const grow = () => {
    lines[lines.length - 1].end = end;
    lines.push({ raw: "", end: "" });
  };
  const reach = (line: number) => {
    while (lines.length <= line) grow();
  };
  return {
    lines,
    reach,
    insert: (at: number, raw: string) => {
      reach(at);
      lines.splice(at, 0, { raw, end });
    },
    text: () => {
      if (lines[lines.length - 1].raw !== "") grow();
      return lines.map((l) => l.raw + l.end).join("\n");
    },
  };
}

/** A cell anew, with the blanks that stood around the old one. */
function placed(old: string, value: string, separator: Separator): string {
  const around = separator === "\t" || value === "" ? null : old.match(/^(\s*)\S.*?(\s*)$/s);
  return (around?.[1] ?? "") + encoded(value, separator) + (around?.[2] ?? "");
}

function withCells(raw: string, separator: Separator, column: number, values: string[], width: number): string {
  const cells = isBlank(raw) ? [""] : split(raw, separator);
  while (cells.length < Math.max(width, column + values.length)) cells.push("");
  values.forEach((v, i) => (cells[column + i] = placed(cells[column + i], v, separator)));
  return cells.join(separator);
}

/** Decimal commas need another separator than commas. */
function withSemicolons(text: string): string {
  const sheet = read(text);
  const change = opened(text);
  sheet.lines.forEach((l, i) => {
    if (l.kind !== "note" && !isBlank(l.raw)) change.lines[i].raw = split(l.raw, ",").map((c) => (c.trim().startsWith('"') ? encoded(plain(c), ";") : c)).join(";");
  });
  return change.text();
}

const isNote = (row: string[]) => row.length === 1 && isComment(row[0]);

/** Puts a block of cells where its first one says; lines and columns are added as needed. */
export function fill(text: string, line: number, column: number, block: string[][]): string {
  const { separator, header, lines } = read(text);
  if (separator === "," && block.flat().some(isCommaNumber)) {
    const other = withSemicolons(text);
    if (other !== text) return fill(other, line, column, block);
    return filled(text, line, column, block, ";", header, 1);
  }
  return filled(text, line, column, block, separator, header, lines[header]?.cells.length ?? 1);
}

function filled(text: string, line: number, column: number, block: string[][], separator: Separator, header: number, width: number): string {
  const change = opened(text);
  change.reach(line + block.length - 1);
  block.forEach((row, i) => {
    const l = change.lines[line + i];
    l.raw = isNote(row) ? row[0] : withCells(isComment(l.raw) ? "" : l.raw, separator, column, row, line + i === header ? 1 : width);
  });
  const wanted = Math.max(width, ...block.filter((r) => !isNote(r)).map((r) => column + r.length));
  return wanted > width ? widened(change.text(), header, separator, wanted) : change.text();
}

/** Every line of the table with as many cells as its header is to have. */
function widened(text: string, header: number, separator: Separator, columns: number): string {
  const change = opened(text);
  for (const l of change.lines.slice(header)) if (l.raw !== "" && !isComment(l.raw)) l.raw = withCells(l.raw, separator, 0, [], columns);
  return change.text();
}

const isNumber = (cell: string) => /^[<>≤≥~±]?\s*[+-]?[.,]?\d/.test(cell.trim());
const isMissing = (cell: string) => /^(n\.? ?[a-z]\.?|k\. ?a\.?|nan|null|[-–—?*x]+)$/i.test(cell.trim());
const filledCells = (row: string[]) => row.map((c) => c.trim()).filter((c) => c !== "");

/** A heading without its unit. */
const bare = (cell: string) => cell.replace(/[[(].*$/, "").trim().toLowerCase();

/** Whether a row names the columns of what is below it: words over numbers, or names that a table may have. */
function areHeadings(row: string[], below: string[][], known: string[]): boolean {
  const cells = filledCells(row);
  const isKnown = (c: string) => known.some((name) => name.toLowerCase() === bare(c));
  if (cells.length === 0) return false;
  if (cells.some(isNumber)) return below.length > 0 && ["theta", "beta"].includes(bare(cells[0])); // angles across
  if (below.length === 0) return cells.every(isKnown);
  const differ = cells.length > 1 && new Set(cells).size === cells.length && !cells.some(isMissing);
  return (differ || cells.some(isKnown)) && below.some((r) => r.some((c, k) => isNumber(c) && filledCells([row[k] ?? ""]).length > 0));
}

/** The row of a block that names its columns, below titles and comments; -1: there is none. */
function headingRow(block: string[][], known: string[]): number {
  const first = block.findIndex((r) => !isNote(r) && (filledCells(r).length > 1 || block.every((o) => filledCells(o).length <= 1)));
  return first >= 0 && areHeadings(block[first], block.slice(first + 1), known) ? first : -1;
}

export interface Pasted {
  text: string;
  replaced: boolean; // values that stood there
}

/** A block that begins with headings is a table of its own, wherever it is put: it takes the place of the one there. One
 *  column goes under its heading, and on the headings, right of the first, a block adds columns. `known`: names that a column may have. */
export function paste(text: string, line: number, column: number, block: string[][], known: string[]): Pasted {
  const now = read(text);
  const blank = now.lines.every((l) => l.kind !== "row" || l.cells.slice(1).every((c) => c === "")); // angles in the first column are no values
  const at = headingRow(block, known);
  const table = block.slice(Math.max(0, at));
  const first = line === now.header && column === 0;
  const part = table.length === 1 || table.every((r) => r.length === 1); // headings alone, or one column: no table of its own
  if (at >= 0 && part && !blank) return { text: fill(text, now.header, column, table), replaced: false };
  if ((at >= 0 && (blank || line !== now.header || column === 0)) || (first && blank && block.length > 1)) {
    const above = block.slice(0, Math.max(0, at)).filter((r) => filledCells(r).length > 0);
    const notes = [...now.lines.slice(0, now.header).map((l) => l.raw), ...above.map((r) => (isNote(r) ? r[0] : `# ${filledCells(r).join(" ")}`))];
    return { text: fill(notes.map((n) => `${n}\n`).join(""), notes.length, 0, table), replaced: !blank };
  }
  return { text: line < now.header ? fill(text, now.header, 0, block) : fill(text, line, column, block), replaced: false }; // what stands above is no table
}

export function setNote(text: string, line: number, raw: string): string {
  const change = opened(text);
  change.lines[line].raw = raw;
  return change.text();
}

export function insertRow(text: string, after: number): string {
  const { lines, header, separator } = read(text);
  const change = opened(text);
  change.insert(after + 1, separator.repeat(Math.max(0, (lines[header]?.cells.length ?? 1) - 1)));
  return change.text();
}

export function removeLine(text: string, line: number): string {
  const change = opened(text);
  change.lines.splice(line, 1);
  if (change.lines.length === 0) return "";
  return change.text();
}

export function addColumn(text: string): string {
  const { columns, header, separator } = read(text);
  return widened(text, header, separator, columns + 1);
}

export function removeColumn(text: string, column: number): string {
  const { lines, separator } = read(text);
  const change = opened(text);
  lines.forEach((l, i) => {
    if (l.kind !== "note" && l.cells.length > column) change.lines[i].raw = split(l.raw, separator).filter((_, k) => k !== column).join(separator);
  });
  return change.text();
}

/** Cells of what a spreadsheet, a web page or a file puts into the clipboard. */
export function block(pasted: string): string[][] {
  const text = pasted.replace(/\r\n?/g, "\n").replace(/\n+$/, "").replace(/^\uFEFF/, "");
  const lines = text.split("\n");
  const numbers = lines.every((l) => isBlank(l) || /^[\s\d.,eE+-]*$/.test(l) && separators(l) <= 1 && (separators(l) === 0 || isCommaNumber(l)));
  const table = lines.filter((l) => !isComment(l)).join("\n");
  const separator = table.includes("\t") ? "\t" : table.includes(";") ? ";" : table.includes(",") && !numbers ? "," : null;
  return separator ? rows(text, separator) : lines.map((l) => [l.trim()]);
}

/** A quoted cell may hold line breaks. */
function rows(text: string, separator: Separator): string[][] {
  const found: string[][] = [];
  let open = ""; // the lines of a row whose quotes are not closed
  for (const line of text.split("\n")) {
    const whole = open === "" ? line : `${open} ${line}`;
    const closed = ((whole.match(/"/g) ?? []).length & 1) === 0;
    open = closed ? "" : whole;
    if (!closed) continue;
    found.push(isComment(whole) ? [whole] : split(whole, separator).map(plain));
  }
  return open === "" ? found : [...found, ...open.split("\n").map((l) => l.split(separator))];
}

// One key of a TOML text: read, and changed in its line. The text is the user's; everything else stays as it is.

const isTable = (line: string) => line.match(/^\s*\[{1,2}\s*([^\]]+?)\s*\]{1,2}/)?.[1];
const value = String.raw`"(?:[^"\\]|\\.)*"|'[^']*'|\[[^\]]*\]|[^#]*?`;
const keyLine = (key: string) => new RegExp(`^(\\s*"?${key}"?\\s*=\\s*)(${value})(\\s*(?:#.*)?\\s*)$`);

/** Lines [first, end) of a table; "": before the first one. null: there is no such table. */
function extent(lines: string[], table: string): [number, number] | null {
  const first = table === "" ? 0 : lines.findIndex((l) => isTable(l) === table) + 1;
  if (table !== "" && first === 0) return null;
  const next = lines.findIndex((l, i) => i >= first && isTable(l) !== undefined);
  return [first, next < 0 ? lines.length : next];
}

function find(lines: string[], table: string, key: string): number {
  const [first, end] = extent(lines, table) ?? [0, 0];
  const at = lines.slice(first, end).findIndex((l) => keyLine(key).test(l));
  return at < 0 ? -1 : first + at;
}

/** As it stands there, strings without their quotes; "": not said. */
export function get(text: string, table: string, key: string): string {
  const lines = text.split("\n");
  const at = find(lines, table, key);
  if (at < 0) return "";
  const found = lines[at].replace(/\r$/, "").match(keyLine(key))![2];
  return found.startsWith('"') ? unquoted(found) : found.replace(/^'(.*)'$/, "$1");
}

/** Whether a table is said in another form than under its own [head]: as specimen.width = ..., specimen = { ... }. */
export function isElsewhere(text: string, table: string): boolean {
  const lines = text.split("\n");
  const [first, end] = extent(lines, "")!;
  const key = new RegExp(`^\\s*(["']?)${table}\\1\\s*[.=]`);
  const head = new RegExp(`^\\s*(["'])${table}\\1\\s*$`);
  return lines.slice(first, end).some((l) => key.test(l)) || lines.some((l) => head.test(isTable(l) ?? ""));
}

function unquoted(text: string): string {
  try {
    return JSON.parse(text) as string;
  } catch {
    return text.slice(1, -1);
  }
}

/** `written` as TOML; null takes the line away. */
export function set(text: string, table: string, key: string, written: string | null): string {
  const lines = text.split("\n");
  const at = find(lines, table, key);
  if (at >= 0 && written === null) lines.splice(at, 1);
  else if (at >= 0) lines[at] = lines[at].replace(keyLine(key), (_, before: string, __, after: string) => before + written + after);
  else if (written !== null) insert(lines, table, `${key} = ${written}`);
  return lines.join("\n");
}

/** After the last key of its table. */
function insert(lines: string[], table: string, line: string) {
  const range = extent(lines, table);
  if (!range) {
    while (lines.length > 0 && lines[lines.length - 1].trim() === "") lines.pop();
    lines.push("", `[${table}]`, line, "");
    return;
  }
  const [first, end] = range;
  const last = lines.slice(first, end).findLastIndex((l) => /^\s*[^#\s][^=]*=/.test(l));
  lines.splice(last < 0 ? first : first + last + 1, 0, line);
}

export const quoted = (text: string) => JSON.stringify(text);

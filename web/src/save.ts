// Tables and charts of a page as files: CSV, a workbook, SVG, PNG. All is made in the browser.
import { h } from "./dom";

const plainName = (name: string) => name.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-+|-+$/g, "").slice(0, 60) || "phyllite";

export function saveFile(name: string, ending: string, content: Blob) {
  const address = URL.createObjectURL(content);
  h("a", { href: address, download: `${plainName(name)}.${ending}` }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

function saver(text: string, label: string, act: () => void): HTMLElement {
  const button = h("button", { type: "button", class: "save", "aria-label": label }, text);
  button.addEventListener("click", act);
  return button;
}

// --- tables --------------------------------------------------------------------------------------------------

type Cells = string[][];

/** As they are read; a unit below a heading stands beside it. */
export function cellsOf(table: HTMLTableElement): Cells {
  const text = (cell: HTMLTableCellElement) => [...cell.childNodes].map((n) => (n.textContent ?? "").trim()).filter(Boolean).join(" ");
  const headed = (cell: HTMLTableCellElement) => {
    const unit = cell.querySelector("small")?.textContent;
    return unit ? `${text(cell).slice(0, -unit.length).trim()} [${unit}]` : text(cell);
  };
  return [...table.rows].map((row) => [...row.cells].map((c) => (c.closest("thead") ? headed(c) : text(c))));
}

/** What other programs take for a number. */
const asNumber = (text: string) => (/^[+\u2212-]?\d+(\.\d+)?(e[+-]?\d+)?$/i.test(text) ? text.replace("\u2212", "-").replace(/^\+/, "") : null);

export const csvOf = (rows: Cells) => rows.map((row) => row.map((cell) => asNumber(cell) ?? (/[",\n;]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell)).join(",")).join("\r\n") + "\r\n";

const marked = (text: string) => text.replace(/[\x00-\x08\x0b\x0c\x0e-\x1f]/g, "").replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

function sheetXml(rows: Cells): string {
  const cell = (text: string) => {
    const number = asNumber(text);
    return number !== null ? `<c><v>${number}</v></c>` : `<c t="inlineStr"><is><t xml:space="preserve">${marked(text)}</t></is></c>`;
  };
  return `<worksheet xmlns="${ofSheets}"><sheetData>${rows.map((r) => `<row>${r.map(cell).join("")}</row>`).join("")}</sheetData></worksheet>`;
}

const ofSheets = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const ofPackages = "http://schemas.openxmlformats.org/package/2006";
const ofDocuments = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";

/** A workbook admits 31 characters, none of these signs, and no name twice. */
function sheetNames(names: string[]): string[] {
  const given = new Set<string>();
  return names.map((name) => {
    const plain = name.replace(/[[\]:*?/\\']/g, " ").trim() || "table";
    let free = plain.slice(0, 31);
    for (let i = 2; given.has(free.toLowerCase()); ++i) free = `${plain.slice(0, 27)} ${i}`;
    given.add(free.toLowerCase());
    return free;
  });
}

/** Office Open XML (ISO/IEC 29500), the least that spreadsheets read. */
export function workbook(tables: { name: string; rows: Cells }[]): Blob {
  const names = sheetNames(tables.map((t) => t.name));
  const relation = (id: string, kind: string, target: string) => `<Relationship Id="${id}" Type="${ofDocuments}/${kind}" Target="${target}"/>`;
  const relations = (all: string) => `<Relationships xmlns="${ofPackages}/relationships">${all}</Relationships>`;
  const type = (part: string, what: string) => `<Override PartName="${part}" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.${what}+xml"/>`;
  const files: [string, string][] = [
    ["[Content_Types].xml", `<Types xmlns="${ofPackages}/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>${type("/xl/workbook.xml", "sheet.main")}${tables.map((_, i) => type(`/xl/worksheets/sheet${i + 1}.xml`, "worksheet")).join("")}</Types>`],
    ["_rels/.rels", relations(relation("rId1", "officeDocument", "xl/workbook.xml"))],
    ["xl/workbook.xml", `<workbook xmlns="${ofSheets}" xmlns:r="${ofDocuments}"><sheets>${names.map((n, i) => `<sheet name="${marked(n)}" sheetId="${i + 1}" r:id="rId${i + 1}"/>`).join("")}</sheets></workbook>`],
    ["xl/_rels/workbook.xml.rels", relations(tables.map((_, i) => relation(`rId${i + 1}`, "worksheet", `worksheets/sheet${i + 1}.xml`)).join(""))],
    ...tables.map((t, i): [string, string] => [`xl/worksheets/sheet${i + 1}.xml`, sheetXml(t.rows)]),
  ];
  return zip(files.map(([name, text]) => [name, `<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n${text}`]));
}

function crc32(of: Uint8Array): number {
  let crc = ~0;
  for (const byte of of) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (0xedb88320 & -(crc & 1));
  }
  return ~crc >>> 0;
}

const littleEndian = (fields: [size: 2 | 4, value: number][]) => new Uint8Array(fields.flatMap(([size, value]) => Array.from({ length: size }, (_, i) => (value >>> (8 * i)) & 255)));

/** Files one after the other, not compressed. */
function zip(files: [string, string][]): Blob {
  const utf8 = new TextEncoder();
  const [parts, directory]: [Uint8Array[], Uint8Array[]] = [[], []];
  let at = 0;
  for (const [path, text] of files) {
    const [name, content] = [utf8.encode(path), utf8.encode(text)];
    // version, UTF-8 names, stored, 1980-01-01
    const about: [2 | 4, number][] = [[2, 20], [2, 0x800], [2, 0], [2, 0], [2, 33], [4, crc32(content)], [4, content.length], [4, content.length], [2, name.length], [2, 0]];
    const local = littleEndian([[4, 0x04034b50], ...about]);
    directory.push(littleEndian([[4, 0x02014b50], [2, 20], ...about, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]]), name);
    parts.push(local, name, content);
    at += local.length + name.length + content.length;
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const end = littleEndian([[4, 0x06054b50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, size], [4, at], [2, 0]]);
  return new Blob([...parts, ...directory, end] as BlobPart[], { type: "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet" });
}

/** A table with a way to take it out. `region`: what dom.ts makes. */
export function savable(region: HTMLElement): HTMLElement {
  const name = region.getAttribute("aria-label") ?? "table";
  const csv = () => saveFile(name, "csv", new Blob(["\ufeff", csvOf(cellsOf(region.querySelector("table")!))], { type: "text/csv" }));
  return h("div", {}, region, h("p", { class: "saves" }, saver("CSV", `Save ${name} as CSV`, csv)));
}

/** All tables of a page, a sheet each. */
export const allTables = () => workbook([...document.querySelectorAll<HTMLTableElement>("main table")].map((t) => ({ name: t.caption?.textContent || (t.closest("[aria-label]")?.getAttribute("aria-label") ?? "table"), rows: cellsOf(t) })));

// --- charts --------------------------------------------------------------------------------------------------

/** A drawing on its own: its colours are the page's, so they are written out. */
export function svgOf(drawn: SVGSVGElement): string {
  const copy = drawn.cloneNode(true) as SVGSVGElement;
  const page = getComputedStyle(document.documentElement);
  const written = (text: string) => text.replace(/var\((--[\w-]+)(?:,[^()]*)?\)/g, (_, name: string) => page.getPropertyValue(name).trim() || "currentColor");
  for (const e of [copy, ...copy.querySelectorAll("*")]) for (const a of e.attributes) if (a.value.includes("var(")) a.value = written(a.value);
  copy.querySelectorAll('[aria-label="tip"]').forEach((tip) => tip.remove());
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  Object.assign(copy.style, { color: page.getPropertyValue("--ink").trim(), fontFamily: "Arial, Helvetica, DejaVu Sans, sans-serif", background: page.getPropertyValue("--surface").trim() });
  return new XMLSerializer().serializeToString(copy);
}

const dense = 3; // pixels of a PNG per pixel of the page

async function pngOf(drawn: SVGSVGElement): Promise<Blob | null> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgOf(drawn))}`;
  await image.decode();
  const { width, height } = drawn.viewBox.baseVal;
  const canvas = h("canvas", { width: String(dense * width), height: String(dense * height) });
  canvas.getContext("2d")!.drawImage(image, 0, 0, dense * width, dense * height);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
}

/** `place`: where the chart is drawn. */
export function chartSavers(place: HTMLElement, name: string): HTMLElement {
  const drawn = () => place.querySelector<SVGSVGElement>(":scope > svg, :scope > figure > svg");
  const svg = () => drawn() && saveFile(name, "svg", new Blob([svgOf(drawn()!)], { type: "image/svg+xml" }));
  const png = () => drawn() && void pngOf(drawn()!).then((made) => made && saveFile(name, "png", made));
  return h("p", { class: "saves" }, saver("SVG", `Save ${name} as SVG`, svg), saver("PNG", `Save ${name} as PNG`, png));
}

export { saver };

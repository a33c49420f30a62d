// The table as a grid of cells: typed and pasted into as in a spreadsheet. It edits the text, line by line (sheet.ts).
import { h } from "../dom";
import { Problem } from "./server";
import { Line, Sheet, block, fill, paste, read, setNote } from "./sheet";

interface Place {
  line: number;
  column: number;
}

export class Grid {
  readonly node = h("div", { class: "scroll sheet" });
  private text = "";
  private problems: Problem[] = [];
  private sheet: Sheet = read("");
  private at: Place = { line: 0, column: 0 };
  private step = 0;

  /** `edited` gets the new text and a name for edits that are undone together; `replaced` hears of a pasted table that has taken the
   *  place of another. */
  constructor(
    private readonly edited: (text: string, step: string) => void,
    private readonly steps: { undo: () => void; redo: () => void },
    private readonly leave: () => void,
    private readonly names: string[], // that a column may have
    private readonly replaced: () => void,
  ) {
    this.node.addEventListener("input", (e) => this.typed(e.target as HTMLInputElement));
    this.node.addEventListener("paste", (e) => this.pasted(e));
    this.node.addEventListener("keydown", (e) => this.pressed(e));
    this.node.addEventListener("focusin", (e) => this.entered(e.target as HTMLElement));
  }

  /** Of the cell that has, or had, the focus. */
  get place(): Place {
    return this.at;
  }

  set(text: string) {
    if (text === this.text && this.node.firstChild) return;
    this.text = text;
    this.sheet = read(text);
    this.draw();
  }

  /** Marks the cells, and says under each line what is wrong with it. */
  mark(problems: Problem[]) {
    this.problems = problems.filter((p) => p.line !== null);
    this.node.querySelectorAll(".says").forEach((r) => r.remove());
    for (const i of this.node.querySelectorAll("[aria-invalid]")) {
      i.removeAttribute("aria-invalid");
      i.removeAttribute("aria-describedby");
    }
    for (const line of new Set(this.problems.map((p) => p.line! - 1))) this.markLine(line);
  }

  focus(to: Place) {
    const line = Math.min(to.line, this.sheet.lines.length);
    const column = Math.min(to.column, this.sheet.columns - 1);
    (this.cell(line, column) ?? this.cell(line, 0))?.focus();
  }

  private cell(line: number, column: number): HTMLInputElement | null {
    return this.node.querySelector(`input[data-line="${line}"][data-column="${column}"]`);
  }

  // --- drawing ------------------------------------------------------------------------------------------------

  private draw() {
    const active = this.node.contains(document.activeElement) ? (document.activeElement as HTMLInputElement) : null;
    const caret = active?.selectionStart ?? 0;
    const { lines, header } = this.sheet;
    const rows = lines.map((l, i) => this.row(l, i));
    const next = lines.length;
    rows.push(this.row({ kind: next <= header ? "header" : "row", raw: "", cells: [] }, next));
    this.node.replaceChildren(h("table", { "aria-label": "Table of tests" }, h("tbody", {}, ...rows)));
    this.mark(this.problems);
    if (!active) return;
    this.focus(this.at);
    (document.activeElement as HTMLInputElement).setSelectionRange?.(caret, caret);
  }

  private row(line: Line, at: number): HTMLElement {
    const number = h("th", { scope: "row", class: "number" }, String(at + 1));
    if (line.kind === "note") {
      const words = this.input(at, 0, line.raw, `Line ${at + 1}, a comment`);
      return h("tr", { class: "note", "data-row": String(at) }, number, h("td", { colspan: String(this.sheet.columns) }, words));
    }
    const heads = this.sheet.lines[this.sheet.header]?.cells ?? [];
    const cells = Array.from({ length: this.sheet.columns }, (_, k) => {
      const head = line.kind === "header";
      const label = head ? `Heading of column ${k + 1}` : `${heads[k] || `Column ${k + 1}`}, line ${at + 1}`;
      return h(head ? "th" : "td", head ? { scope: "col" } : {}, this.input(at, k, line.cells[k] ?? "", label, head));
    });
    return h("tr", { class: line.kind, "data-row": String(at) }, number, ...cells);
  }

  private input(line: number, column: number, value: string, label: string, head = false): HTMLInputElement {
    const i = h("input", { type: "text", "data-line": String(line), "data-column": String(column), "aria-label": label, autocomplete: "off", spellcheck: "false", ...(head ? { list: "column-names" } : {}) });
    i.value = value;
    i.style.minWidth = `${Math.min(26, Math.max(6, value.length) + 3)}ch`;
    return i;
  }

  private markLine(line: number) {
    const row = this.node.querySelector(`tr[data-row="${line}"]`);
    if (!row) return;
    const of = this.problems.filter((p) => p.line! - 1 === line);
    const says = of.map((p, k) => {
      const id = `problem-${line}-${k}`;
      const cells = p.column === null ? row.querySelectorAll("input") : row.querySelectorAll(`input[data-column="${p.column}"]`);
      cells.forEach((c) => {
        c.setAttribute("aria-invalid", "true");
        c.setAttribute("aria-describedby", [c.getAttribute("aria-describedby"), id].filter(Boolean).join(" "));
      });
      return h("p", { id }, p.text);
    });
    row.after(h("tr", { class: "says" }, h("td", { colspan: String(this.sheet.columns + 1) }, ...says)));
  }

  // --- editing ------------------------------------------------------------------------------------------------

  private change(text: string, step: string) {
    const before = this.shape();
    this.text = text;
    this.sheet = read(text);
    if (this.shape() !== before) this.draw();
    this.edited(text, step);
  }

  /** While it stays the same, cells need not be made anew. */
  private shape = () => this.sheet.lines.map((l) => l.kind[0]).join("") + this.sheet.columns + this.sheet.header;

  private typed(i: HTMLInputElement) {
    const { line, column } = this.at;
    const note = this.sheet.lines[line]?.kind === "note";
    this.change(note ? setNote(this.text, line, i.value) : fill(this.text, line, column, [[i.value]]), `cell ${line} ${column} ${this.step}`);
    if (this.sheet.header === line) this.relabel();
  }

  private relabel() {
    const heads = this.sheet.lines[this.sheet.header].cells;
    for (const i of this.node.querySelectorAll<HTMLInputElement>("tr.row input"))
      i.setAttribute("aria-label", `${heads[Number(i.dataset.column)] || `Column ${Number(i.dataset.column) + 1}`}, line ${Number(i.dataset.line) + 1}`);
  }

  private pasted(e: ClipboardEvent) {
    const pasted = e.clipboardData?.getData("text/plain") ?? "";
    const cells = block(pasted);
    if (cells.length * cells[0].length === 1) return; // into the cell, where its caret stands
    e.preventDefault();
    this.paste(pasted);
  }

  /** Where the focus is, or was; a block with headings in the place of the table. */
  paste(pasted: string) {
    const cells = block(pasted);
    const { text, replaced } = paste(this.text, this.at.line, this.at.column, cells, this.names);
    this.text = text;
    this.sheet = read(this.text);
    this.draw();
    this.edited(this.text, `paste ${++this.step}`);
    if (replaced) this.replaced();
  }

  private entered(target: HTMLElement) {
    if (!(target instanceof HTMLInputElement)) return;
    const next = { line: Number(target.dataset.line), column: Number(target.dataset.column) };
    if (next.line !== this.at.line || next.column !== this.at.column) ++this.step;
    this.at = next;
    this.node.querySelector("tr.current")?.classList.remove("current");
    target.closest("tr")!.classList.add("current");
  }

  // --- keys ---------------------------------------------------------------------------------------------------

  private pressed(e: KeyboardEvent) {
    const i = e.target;
    if (!(i instanceof HTMLInputElement) || e.altKey) return;
    const key = e.ctrlKey || e.metaKey ? e.key.toLowerCase() : "";
    if (key === "y" || (key === "z" && e.shiftKey)) return this.act(e, () => this.steps.redo());
    if (key === "z") return this.act(e, () => this.steps.undo());
    if (e.ctrlKey || e.metaKey) return;
    const moves: Record<string, () => void> = {
      Enter: () => this.move(e.shiftKey ? -1 : 1, 0),
      ArrowDown: () => this.move(1, 0),
      ArrowUp: () => this.move(-1, 0),
      Escape: () => this.leave(),
    };
    const whole = i.selectionStart === 0 && i.selectionEnd === i.value.length;
    if (!e.shiftKey && (whole || i.selectionEnd === 0)) moves.ArrowLeft = () => this.move(0, -1);
    if (!e.shiftKey && (whole || i.selectionStart === i.value.length)) moves.ArrowRight = () => this.move(0, 1);
    if (moves[e.key]) this.act(e, moves[e.key]);
  }

  private act(e: KeyboardEvent, what: () => void) {
    e.preventDefault();
    what();
  }

  /** To the next cell that is there; what it holds is selected, as in a spreadsheet. */
  private move(lines: number, columns: number) {
    const next = { line: this.at.line + lines, column: this.at.column + columns };
    const to = this.cell(next.line, next.column) ?? (lines !== 0 ? this.cell(next.line, 0) : null);
    to?.focus();
    to?.select();
  }
}

// The rock's table: as a grid, or as the text that it is.
import { fold, h } from "../dom";
import { button, keyed, plainly, textArea } from "./controls";
import { Grid } from "./grid";
import { Checked, Problem, Project } from "./server";
import { addColumn, insertRow, removeColumn, removeLine } from "./sheet";

export interface TableView {
  node: HTMLElement;
  show(text: string | null, file: string): void;
  mark(checked: Checked | null): void;
  paste(text: string): void; // what was pasted beside all fields
}

export function tableView(project: Project, edit: (table: string, step: string) => void, undo: () => void, redo: () => void): TableView {
  const columns = project.columns.map((c) => [c].flat()).filter(([name]) => name !== "-");
  let text: string | null = "";
  let asText = false;
  let steps = 0;
  let found: Problem[] = [];
  let another = ""; // the text that has taken the place of a table
  const grid = new Grid(edit, { undo, redo }, () => names.querySelector("summary")!.focus(), columns.map(([name]) => name), () => {
    another = text ?? "";
    draw();
  });
  const area = textArea((t) => edit(t, "typing the table"), { id: "table-text", "aria-describedby": "table-problems" });
  const change = (f: (text: string) => string) => {
    const place = grid.place;
    edit(f(text ?? ""), `button ${++steps}`);
    grid.focus(place);
  };
  const toggle = button("Edit as text", () => {
    asText = !asText;
    draw();
    say();
  });
  const tools = h(
    "div",
    { class: "tools" },
    button("Insert row below", () => change((t) => insertRow(t, grid.place.line))),
    button("Delete row", () => change((t) => removeLine(t, grid.place.line))),
    button("Add column", () => change(addColumn)),
    button("Delete column", () => change((t) => removeColumn(t, grid.place.column))),
  );
  const problems = h("ul", { class: "problems", id: "table-problems" });
  const place = h("div");
  const files = h("div");
  const names = fold("Names that a column may have", h("dl", {}, ...columns.flatMap(([name, word]) => [h("dt", {}, name), h("dd", {}, word ?? "")])));
  const workbook = h("p", { class: "warning" });
  const taken = h("p", { class: "warning", role: "status" });
  const pasting = h("p", { class: "muted" }, "Copy the table in Excel, click any cell and paste, headings included. One row per specimen, or per angle with SD and number; the unit stands in the heading. Enter and arrow keys move, Esc leaves the cells.");
  const buttons = h("div", { class: "tools" }, toggle, tools);
  const textField = h("div", { class: "field" }, h("label", { for: "table-text" }, "Table as text"), area.node);

  function draw() {
    toggle.textContent = asText ? "Edit as cells" : "Edit as text";
    tools.hidden = asText;
    keyed(place, asText, () => [asText ? textField : grid.node]);
    if (asText) area.set(text ?? "");
    else grid.set(text ?? "");
    taken.textContent = text === another && another !== "" ? "What was pasted begins with headings: it has taken the place of the table. Undo brings the old one back." : "";
    taken.hidden = taken.textContent === "";
  }

  function say() {
    grid.mark(found);
    const listed = asText || text === null ? found : found.filter((p) => p.line === null);
    const goTo = asText && text !== null ? area.goTo : null;
    keyed(problems, [listed, goTo !== null], () => listed.map((p) => problemItem(p, goTo)));
  }

  return {
    node: h(
      "div",
      {},
      pasting,
      workbook,
      taken,
      buttons,
      problems,
      place,
      files,
      names,
      h("datalist", { id: "column-names" }, ...columns.map(([name]) => h("option", { value: name }))),
    ),
    show(next, file) {
      text = next;
      workbook.hidden = next !== null;
      workbook.textContent = `${file} is edited in its own program: a workbook, a file outside this folder, or too large. The page reads it again when it changes.`;
      for (const n of [pasting, buttons, place]) n.hidden = next === null;
      keyed(files, file, () => [h("p", { class: "muted" }, "The file: ", h("code", {}, file))]);
      draw();
    },
    paste: (pasted) => text !== null && grid.paste(pasted),
    mark(checked) {
      found = checked?.problems.filter((p) => p.where === "table") ?? [];
      say();
    },
  };
}

/** What is wrong, and a way to the line where. */
export function problemItem(p: Problem, goTo: ((line: number) => void) | null): HTMLElement {
  const line = p.line;
  return h("li", {}, line !== null && (goTo ? button(`Line ${line}`, () => goTo(line - 1), { class: "link" }) : `Line ${line}`), line !== null && ": ", plainly(p.text));
}

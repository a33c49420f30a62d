// The first screen: a rock to try, a table to bring, a rock to open.
import { Child, h } from "../dom";
import { argument, attempt, button, command, field, input, keyed, objections, select } from "./controls";
import { Files, Project, RockAnswer, ask, upload } from "./server";
import { block, paste } from "./sheet";
import { quoted, set } from "./toml";

/** The measured rock that is offered, on grains so large that an answer takes about a minute: as examples/demo/boryeong.toml. */
const trial = { rock: "boryeong-shale", title: "Boryeong shale", grains: "1.66 mm", options: { effort: "quick" } };

export interface StartView {
  node: HTMLElement;
  /** A table that was pasted or dropped, as a new rock; `file`: what it was called. */
  bring(table: string, file: string): Promise<void>;
  bringFile(file: File): Promise<void>;
}

const rockAddress = (name: string) => `/api/rock?name=${encodeURIComponent(name)}`;

/** A name that a rock may have, of a file's. */
function nameOf(file: string): string {
  const stem = file.replace(/\.[^.]*$/, "").replace(/[/\\"']/g, " ").trim().replace(/^[.\-\s]+/, "");
  return stem.slice(0, 40).trim() || "rock";
}

/** `opened` shows a rock; `begun` is called where its calibration has been started. */
export function startView(project: () => Project, opened: (name: string) => Promise<void>, begun: () => void): StartView {
  const wrong = objections();
  const asked = h("div");
  const name = input((typed) => keyed(asked, typed, () => [typed.trim() !== "" && command(`phyllite rock new ${argument(typed.trim())}`)]), { required: "" });
  const known = (n: string) => project().rocks.some((r) => r.name === n);

  function free(wanted: string): string {
    let found = wanted;
    for (let i = 2; known(found); ++i) found = `${wanted}-${i}`;
    return found;
  }

  /** `change`: what the files of an empty rock become. */
  async function make(wanted: string, change: (empty: Files) => Files) {
    const { table, toml, stamp } = await ask<RockAnswer>(rockAddress(wanted));
    await ask("/api/save", { name: wanted, ...change({ table, toml }), stamp });
    name.value = "";
    asked.replaceChildren();
    await opened(wanted);
  }

  const measured = (of: string, grains = "") =>
    ask<Files>(`/api/base?name=${encodeURIComponent(of)}`).then((files) => (data: string): Files => {
      const toml = set(files.toml, "", "data", quoted(data));
      return { table: files.table, toml: grains ? set(toml, "", "grain_size", quoted(grains)) : toml };
    });

  async function tryIt() {
    if (known(trial.rock)) return opened(trial.rock);
    const files = await measured(trial.rock, trial.grains);
    await make(trial.rock, () => files(`${trial.rock}.csv`));
    await ask("/api/calibrate", { name: trial.rock, options: trial.options, resume: false, anew: false });
    begun();
  }

  async function bring(table: string, file: string) {
    const wanted = free(name.value.trim() || nameOf(file));
    await make(wanted, (empty) => ({ ...empty, table: file === "" ? paste("", 0, 0, block(table), project().columns.map((c) => [c].flat()[0])).text : table }));
  }

  async function bringFile(file: File) {
    const isText = /\.(csv|tsv|txt)$/i.test(file.name);
    const table = isText ? await file.text() : (await upload<{ table: string }>(`/api/table?name=${encodeURIComponent(file.name)}`, file)).table;
    await bring(table, file.name);
  }

  const chooser = h("input", { type: "file", accept: ".csv,.tsv,.txt,.xlsx,.ags", id: "table-file" });
  chooser.addEventListener("change", () => {
    const file = chooser.files?.[0];
    if (file) void attempt(wrong, () => bringFile(file)).then(() => (chooser.value = ""));
  });

  const form = h("form", {}, field("Name of the new rock", name), h("button", { type: "submit" }, "New rock"));
  form.addEventListener("submit", (e) => {
    e.preventDefault();
    void attempt(wrong, async () => {
      const wanted = name.value.trim();
      if (known(wanted)) throw new Error(`there is already a rock ${wanted}`);
      await make(wanted, (empty) => empty);
      document.querySelector<HTMLInputElement>(".sheet tr.header input")?.focus();
    });
  });

  let like = trial.rock;
  const rocks = select(project().measured.map((r) => [r, r.replaceAll("-", " ")]), (v) => (like = v));
  rocks.value = like;
  const copy = button("Begin with its table", () =>
    attempt(wrong, async () => {
      const files = await measured(like);
      const wanted = free(like);
      await make(wanted, () => files(`${wanted}.csv`));
    }),
  );

  const tile = (title: string, ...children: Child[]) => h("section", { class: "tile", "aria-label": title }, h("h3", {}, title), ...children);
  return {
    node: h(
      "div",
      {},
      wrong,
      h(
        "div",
        { class: "tiles" },
        tile("Try one", h("p", {}, "A measured shale, calibrated before your eyes. On coarse grains it takes about a minute."), button(`Try ${trial.title}`, () => void attempt(wrong, tryIt), { class: "main" })),
        tile("Bring your table", h("p", {}, "Paste it here with Ctrl+V, or drop a file on this page: .csv or .xlsx."), field("Choose a file", chooser), form, asked),
        tile("Begin with a measured rock", h("p", {}, "The program has measured rocks with their sources."), field("Measured rock", rocks), h("div", { class: "tools" }, copy)),
      ),
    ),
    bring: (table, file) => attempt(wrong, () => bring(table, file)),
    bringFile: (file) => attempt(wrong, () => bringFile(file)),
  };
}

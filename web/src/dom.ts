// Elements of the pages: made from text, never from markup.

export type Child = Node | string | null | false;

/** Makes an element; text goes in as text, never as markup. */
export function h<K extends keyof HTMLElementTagNameMap>(name: K, attributes: Record<string, string> = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const e = document.createElement(name);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  for (const c of children) if (c) e.append(c);
  return e;
}

export function labelled(text: string, control: HTMLElement): HTMLElement {
  return h("label", {}, text, control);
}

export function choice(options: [string, string][], onChange: (value: string) => void, id: string): HTMLSelectElement {
  const s = h("select", { id }, ...options.map(([v, text]) => h("option", { value: v }, text)));
  s.addEventListener("change", () => onChange(s.value));
  return s;
}

export function check(id: string, on: boolean, onChange: (on: boolean) => void): HTMLInputElement {
  const c = h("input", { type: "checkbox", id });
  c.checked = on;
  c.addEventListener("change", () => onChange(c.checked));
  return c;
}

export const fold = (title: string, ...children: Child[]) => h("details", {}, h("summary", {}, title), ...children);

/** In a box of its own that scrolls where the page is narrow. */
export function table(label: string, heads: Child[], rows: Child[][], caption: string | null = null, words: number[] = []): HTMLElement {
  const of = (i: number): Record<string, string> => (words.includes(i) ? { class: "words" } : {});
  return h(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": label },
    h(
      "table",
      {},
      caption && h("caption", {}, caption),
      h("thead", {}, h("tr", {}, ...heads.map((x, i) => h("th", { scope: "col", ...of(i) }, x)))),
      h("tbody", {}, ...rows.map((r) => h("tr", {}, h("th", { scope: "row" }, r[0]), ...r.slice(1).map((x, i) => (x instanceof HTMLTableCellElement ? x : h("td", of(i + 1), x)))))),
    ),
  );
}

export function copyButton(text: string | (() => string)): HTMLElement {
  const b = h("button", { type: "button" }, "Copy");
  b.addEventListener("click", async () => {
    await navigator.clipboard?.writeText(typeof text === "string" ? text : text());
    b.textContent = "Copied";
    setTimeout(() => (b.textContent = "Copy"), 1500);
  });
  return b;
}

/** A place on the page in which something is drawn. */
export interface Chart {
  node: HTMLElement;
  place: HTMLElement; // of the chart
  redraw(always?: boolean): void; // where its width has changed
}

export function figure(label: string, caption: Child, draw: (width: number, place: HTMLElement) => Node): Chart {
  const place = h("div", { class: "plot" });
  let drawn = 0;
  const redraw = (always = false) => {
    const width = Math.floor(place.clientWidth);
    if (width < 10 || (!always && Math.abs(width - drawn) < 2)) return;
    drawn = width;
    const node = draw(width, place);
    if (node instanceof Element) {
      node.setAttribute("role", "img");
      node.setAttribute("aria-label", label);
      node.querySelectorAll("g[aria-label]").forEach((g) => g.setAttribute("role", "group")); // Plot labels what may have no label otherwise
    }
    place.querySelector(":scope > svg, :scope > figure")?.remove();
    place.prepend(node);
  };
  return { node: h("figure", {}, h("h3", {}, label), place, caption && h("figcaption", {}, caption)), place, redraw };
}

/** Follows the system until the reader chooses; `kept` is where the choice outlives the page. */
export function theme(changed: () => void, kept: Storage | null = null): () => void {
  const root = document.documentElement;
  const system = matchMedia("(prefers-color-scheme: dark)");
  let chosen = kept?.getItem("phyllite theme") ?? null;
  const apply = () => {
    root.dataset.theme = chosen ?? (system.matches ? "dark" : "light");
    changed();
  };
  system.addEventListener("change", apply);
  document.getElementById("theme")!.addEventListener("click", () => {
    chosen = root.dataset.theme === "dark" ? "light" : "dark";
    kept?.setItem("phyllite theme", chosen);
    apply();
  });
  apply();
  return apply;
}

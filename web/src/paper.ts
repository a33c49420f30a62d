// The report on paper: laid out for A4 before the browser asks for it, so that charts and specimens are drawn at their
// final size, and text keeps its own.

/** `text` inside a string of CSS. */
const quotedCss = (text: string) => `"${text.replace(/[\x00-\x1f"\\<]/g, (c) => `\\${c.charCodeAt(0).toString(16)} `)}"`;

/** What stands at the foot of every sheet. */
export function paperFoot(left: string) {
  const style = document.createElement("style");
  style.textContent = `@page { @bottom-left { content: ${quotedCss(left)}; } }`;
  document.head.append(style);
}

/** `layOut` draws everything anew, on paper and back on the screen. Ctrl+P waits for `drawn`; a browser's menu does not ask. */
export function printing(drawn: Promise<void>, layOut: (paper: boolean) => void): () => void {
  const root = document.documentElement;
  let folded: HTMLDetailsElement[] = [];
  let theme: string | undefined;
  addEventListener("beforeprint", () => {
    theme = root.dataset.theme;
    root.dataset.theme = "light";
    root.classList.add("paper");
    folded = [...document.querySelectorAll<HTMLDetailsElement>("details:not([open])")];
    folded.forEach((d) => (d.open = true));
    layOut(true);
  });
  addEventListener("afterprint", () => {
    folded.forEach((d) => (d.open = false));
    root.classList.remove("paper");
    if (theme) root.dataset.theme = theme;
    layOut(false);
  });
  const whenDrawn = () => void drawn.then(() => print());
  addEventListener("keydown", (e) => {
    if (!(e.ctrlKey || e.metaKey) || e.key.toLowerCase() !== "p" || root.dataset.ready === "true") return;
    e.preventDefault();
    whenDrawn();
  });
  return whenDrawn;
}

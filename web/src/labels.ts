// What stands above and below the specimens of a viewer: in parts of its place, so that paper of another width keeps it there.
import { Child, h } from "./dom";
import { Viewer, headHeight } from "./viewer";

export interface Label {
  head: string;
  color: string;
  foot: Child[];
}

/** Lays the words anew; `of` says them for a specimen. */
export function labelSpecimens(viewer: Viewer, overlay: HTMLElement, of: (test: number) => Label) {
  overlay.replaceChildren();
  const part = (length: number, whole: number) => `${((100 * length) / Math.max(1, whole)).toFixed(3)}%`;
  const [width, height] = [viewer.canvas.clientWidth, viewer.height];
  for (const cell of viewer.cells) {
    const at = (top: number) => `left:${part(cell.left, width)};width:${part(cell.width, width)};top:${part(top, height)}`;
    const { head, color, foot } = of(cell.test);
    const absent = viewer.absent(cell.test);
    overlay.append(h("div", { class: "head", style: `${at(cell.top - headHeight)};color:${color}` }, head), h("div", { class: "foot", style: at(cell.top + cell.height) }, ...foot));
    if (absent) overlay.append(h("div", { class: "absent", style: at(cell.top + 0.45 * cell.height) }, absent));
  }
}

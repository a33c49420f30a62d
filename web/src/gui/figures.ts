// Charts whose numbers come and change while the page is open.
import { Chart, figure, h } from "../dom";
import { chartSavers } from "../save";

/** A grid of charts, one per name; each is made once and drawn again with new numbers. */
export class Figures {
  readonly node: HTMLElement;
  private made = new Map<string, { figure: Chart; draw: (width: number) => Node; shown: string; caption: Text }>();
  private observer = new ResizeObserver(() => this.made.forEach((m) => m.figure.redraw()));

  /** `saved`: each can be taken out as a file. */
  constructor(
    style: string,
    private readonly saved = false,
  ) {
    this.node = h("div", { class: style });
  }

  /** `shown`: what is drawn; the same again is not drawn again. */
  show(charts: { name: string; shown: unknown; caption?: string; draw: (width: number) => Node }[]) {
    for (const [name, m] of this.made)
      if (!charts.some((c) => c.name === name)) {
        this.observer.unobserve(m.figure.place);
        m.figure.node.remove();
        this.made.delete(name);
      }
    for (const c of charts) this.one(c.name, JSON.stringify(c.shown), c.caption ?? "", c.draw);
  }

  private one(name: string, shown: string, caption: string, draw: (width: number) => Node) {
    const known = this.made.get(name);
    if (known) {
      if (known.shown === shown) return;
      Object.assign(known, { shown, draw });
      known.caption.data = caption;
      return known.figure.redraw(true);
    }
    const words = document.createTextNode(caption);
    const entry = { shown, draw, caption: words, figure: figure(name, words, (width) => this.made.get(name)!.draw(width)) };
    this.made.set(name, entry);
    if (this.saved) entry.figure.node.append(chartSavers(entry.figure.place, name));
    this.node.append(entry.figure.node);
    this.observer.observe(entry.figure.place);
  }
}

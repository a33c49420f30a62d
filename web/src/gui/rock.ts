// The rock that is open: its two files as typed and as they lie on disk.
import { draft, keep } from "./drafts";
import { Files, Refused, RockAnswer, ask } from "./server";

type OnDisk = Files & { stamp: string };

const same = (a: Files, b: Files) => a.table === b.table && a.toml === b.toml;
const only = ({ table, toml, stamp }: OnDisk): OnDisk => ({ table, toml, stamp });

export class Rock {
  readonly name: string;
  text: Files;
  theirs: OnDisk | null = null; // the files, where somebody else has changed them since
  gone: boolean; // its files have been deleted
  private disk: OnDisk;
  private past: { text: Files; step: string }[] = [];
  private undone: { text: Files; step: string }[] = [];

  /** `changed` is called whenever something here is another than it was. */
  constructor(
    private readonly folder: string,
    answer: RockAnswer,
    private readonly changed: () => void,
  ) {
    this.name = answer.name;
    this.gone = !answer.exists;
    this.disk = only(answer);
    this.text = { table: answer.table, toml: answer.toml };
  }

  get dirty() {
    return this.gone || !same(this.text, this.disk);
  }
  get canUndo() {
    return this.past.length > 0;
  }
  get canRedo() {
    return this.undone.length > 0;
  }

  /** Edits of one step, such as typing in one cell, are undone together. */
  edit(change: Partial<Files>, step: string) {
    const next = { ...this.text, ...change };
    if (same(next, this.text)) return;
    if (this.past.at(-1)?.step !== step) this.past.push({ text: this.text, step });
    this.undone = [];
    this.text = next;
    this.settle();
  }

  undo() {
    this.step(this.past, this.undone);
  }

  redo() {
    this.step(this.undone, this.past);
  }

  private step(from: typeof this.past, to: typeof this.past) {
    const last = from.pop();
    if (!last) return;
    to.push({ text: this.text, step: last.step });
    this.text = last.text;
    this.settle();
  }

  /** A step back would throw away what has been written elsewhere. */
  private forget() {
    this.past = [];
    this.undone = [];
  }

  discard() {
    this.disk = this.theirs ?? this.disk;
    this.theirs = null;
    this.edit({ table: this.disk.table, toml: this.disk.toml }, "discard");
    this.settle();
  }

  /** False: somebody else has changed the files; `theirs` holds them. Throws what ask() throws. */
  async save(): Promise<boolean> {
    const text = this.text;
    try {
      const { stamp } = await ask<{ stamp: string }>("/api/save", { name: this.name, ...text, stamp: this.disk.stamp });
      this.disk = { ...text, stamp };
      this.theirs = null;
      this.gone = false;
    } catch (error) {
      if (!(error instanceof Refused) || error.status !== 409 || error.body.toml === undefined) throw error;
      this.meet(error.body as OnDisk);
    }
    this.settle();
    return this.theirs === null;
  }

  async keepMine(): Promise<boolean> {
    if (this.theirs) this.disk = this.theirs;
    this.theirs = null;
    return this.save();
  }

  /** The files as they are now. */
  meet(files: OnDisk & { exists?: boolean }) {
    if (files.exists === false) return this.lose(files);
    if (files.stamp === this.disk.stamp) {
      if (!this.theirs) return;
      this.theirs = null;
      return this.changed();
    }
    const mine = this.dirty && !same(this.text, files);
    if (mine && this.theirs?.stamp === files.stamp) return;
    this.theirs = mine ? only(files) : null;
    this.gone = false;
    if (!mine) {
      this.forget();
      this.disk = only(files);
      this.text = { table: files.table, toml: files.toml };
    }
    this.settle();
  }

  /** Deleted: what is shown is all that is left of them. */
  private lose(files: OnDisk) {
    if (this.gone && files.stamp === this.disk.stamp) return;
    this.gone = true;
    this.theirs = null;
    this.disk = only(files);
    this.settle();
  }

  /** What another tab, or this one before a reload, has typed. */
  takeDraft() {
    const kept = draft(this.folder, this.name);
    if (!kept && this.gone) return; // saved again: meet() says so
    const next = kept ?? this.disk; // none: saved or thrown away
    if (same(next, this.text)) return;
    this.forget();
    this.text = { table: next.table, toml: next.toml };
    if (kept && kept.stamp !== this.disk.stamp) {
      this.theirs = this.disk;
      this.disk = { ...this.disk, stamp: kept.stamp };
    }
    this.changed();
  }

  private settle() {
    keep(this.folder, this.name, this.dirty ? { ...this.text, stamp: this.disk.stamp } : null);
    this.changed();
  }
}

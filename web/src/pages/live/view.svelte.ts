/// What the person looks at: all of it in the address, so that a copied link shows the same.
import { moved, zoomed } from '../../chart/geometry';
import { loop } from '../../chart/loop';
import { readQuery, setQuery } from '../../router/router.svelte';
import { parseView, viewQuery, type ViewState } from './view_url';

export class LiveView {
  private state = $state.raw<ViewState>(parseView(readQuery));
  /** The tick under the pointer, on any panel; null: none. Not in the address. */
  hover = $state.raw<number | null>(null);
  /** The newest tick, told at most a few times a second. */
  head = $state(0);

  get following(): boolean {
    return this.state.range === null;
  }
  get width(): number {
    return this.state.width;
  }
  get lane(): string | null {
    return this.state.lane;
  }
  get node(): string | null {
    return this.state.node;
  }
  get hidden(): readonly string[] {
    return this.state.hidden;
  }
  get cursor(): number | null {
    return this.state.cursor;
  }
  get picked(): readonly string[] {
    return this.state.signals;
  }
  get errors(): 'lanes' | 'nodes' {
    return this.state.errors;
  }
  get curves(): readonly string[] {
    return this.state.curves;
  }
  /** The tick that panels show the state of; null: the newest. */
  get at(): number | null {
    return this.hover ?? this.state.cursor;
  }

  /** The window in ticks, given the newest tick. */
  window(head: number): { from: number; to: number } {
    if (this.state.range) return this.state.range;
    const to = Math.max(head, this.state.width);
    return { from: to - this.state.width, to };
  }

  private set(changes: Partial<ViewState>): void {
    this.state = { ...this.state, ...changes };
    setQuery(viewQuery(this.state));
    loop.invalidate();
  }

  hold(head: number): void {
    this.set({ range: this.window(head) });
  }
  follow(): void {
    this.set({ range: null, cursor: null });
  }
  show(from: number, to: number): void {
    this.set({ range: { from: Math.round(Math.min(from, to)), to: Math.round(Math.max(from, to, Math.min(from, to) + 4)) } });
  }
  /** The width of a window that follows the run. */
  widen(width: number): void {
    this.set({ width: Math.max(10, Math.round(width)) });
  }
  /** Nearer (factor below 1) or farther. A window that follows stays at the newest tick. */
  zoom(factor: number, head: number, about?: number): void {
    if (this.following && about === undefined && this.cursor === null) {
      this.set({ width: Math.round(Math.min(Math.max(10, this.width * factor), Math.max(10, head))) });
      return;
    }
    const { from, to } = this.window(head);
    const at = this.at !== null && this.at >= from && this.at <= to ? this.at : (from + to) / 2;
    this.set({ range: zoomed(from, to, factor, about ?? at, head) });
  }
  move(by: number, head: number): void {
    const { from, to } = this.window(head);
    this.set({ range: moved(from, to, by, head) });
  }
  whole(head: number): void {
    this.set({ range: { from: 0, to: Math.max(4, head) } });
  }
  pin(k: number | null): void {
    this.set({ cursor: k === null ? null : Math.round(k) });
  }
  /** Moves the cursor, taking the window along where it would leave it. */
  step(by: number, head: number): void {
    const k = Math.min(head, Math.max(0, (this.at ?? head) + by));
    this.hover = null;
    const { from, to } = this.window(head);
    const range = k < from ? moved(from, to, k - from, head) : k > to ? moved(from, to, k - to, head) : { from, to };
    this.set({ cursor: Math.round(k), range });
  }
  chooseLane(lane: string): void {
    this.set({ lane, hidden: this.state.hidden.filter((id) => id !== lane) });
  }
  chooseNode(node: string): void {
    this.set({ node });
  }
  toggle(lane: string): void {
    const hidden = this.state.hidden.includes(lane) ? this.state.hidden.filter((id) => id !== lane) : [...this.state.hidden, lane];
    this.set({ hidden });
  }
  /** Shows or hides a kind of curve on every panel. */
  turn(curve: string): void {
    const curves = this.state.curves.includes(curve) ? this.state.curves.filter((id) => id !== curve) : [...this.state.curves, curve];
    this.set({ curves });
  }
  /** Shows this lane alone; again: all. */
  solo(lane: string, all: readonly string[]): void {
    const others = all.filter((id) => id !== lane);
    const alone = others.every((id) => this.state.hidden.includes(id)) && !this.state.hidden.includes(lane);
    this.set({ hidden: alone ? [] : others });
  }
  pick(signals: readonly string[]): void {
    this.set({ signals: [...signals] });
  }
  showErrors(errors: 'lanes' | 'nodes'): void {
    this.set({ errors });
  }
}

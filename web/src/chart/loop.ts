/// One drawing loop for every panel: draws what is on the screen, when something changed, once a frame of the display.
export interface Drawable {
  element: Element;
  draw(): void;
}

const quietMs = 1000;
const budgetMs = 12;

class Loop {
  private readonly items = new Map<Drawable, boolean>();
  private readonly observer: IntersectionObserver | null;
  private requested = false;
  private lastData = 0;
  private readonly quiet = typeof matchMedia === 'function' ? matchMedia('(prefers-reduced-motion: reduce)') : null;
  private pending: ReturnType<typeof setTimeout> | null = null;
  /** Time the last drawing of all panels took, and a smoothed one, in ms. */
  drawMs = 0;

  constructor() {
    this.observer =
      typeof IntersectionObserver === 'function'
        ? new IntersectionObserver((entries) => {
            for (const entry of entries) {
              for (const item of this.items.keys()) if (item.element === entry.target) this.items.set(item, entry.isIntersecting);
            }
            this.invalidate();
          })
        : null;
  }

  add(item: Drawable): () => void {
    this.items.set(item, true);
    this.observer?.observe(item.element);
    this.invalidate();
    return () => {
      this.observer?.unobserve(item.element);
      this.items.delete(item);
    };
  }

  /** Draws at the next display frame: for what the person does. */
  invalidate(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => this.run());
  }

  /** For new data: once a second for who asked for less motion, less often where drawing is slow. Never forgotten. */
  data(): void {
    const rest = this.quiet?.matches ? quietMs : this.drawMs > budgetMs ? 3 * this.drawMs : 0;
    const wait = this.lastData + rest - performance.now();
    if (wait <= 0) {
      this.lastData = performance.now();
      this.invalidate();
      return;
    }
    this.pending ??= setTimeout(() => {
      this.pending = null;
      this.data();
    }, wait);
  }

  private run(): void {
    this.requested = false;
    const begin = performance.now();
    for (const [item, visible] of this.items) if (visible) item.draw();
    this.drawMs = 0.8 * this.drawMs + 0.2 * (performance.now() - begin);
  }
}

export const loop = new Loop();

import { theme } from '../theme/theme.svelte';
import { loop } from './loop';

/**
 * Lets the common loop draw what stands in `element`: with new data, and when its size, the theme or anything that `shown`
 * reads changes. Call while a component is made.
 */
export function drawn(element: () => HTMLElement | undefined, draw: () => void, shown: () => unknown): void {
  $effect(() => {
    const place = element();
    if (!place) return undefined;
    const stop = loop.add({ element: place, draw });
    const observer = new ResizeObserver(() => loop.invalidate());
    observer.observe(place);
    return () => {
      stop();
      observer.disconnect();
    };
  });
  $effect(() => {
    void [theme.shown, shown()];
    loop.invalidate();
  });
}

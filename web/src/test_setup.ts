/// What jsdom lacks and the page needs; and a page that is taken down after every test.
import { cleanup, configure } from '@testing-library/svelte';
import { afterEach } from 'vitest';

// Tests share a machine with other work.
configure({ asyncUtilTimeout: 30_000 });
afterEach(() => cleanup());

HTMLDialogElement.prototype.showModal ??= function (this: HTMLDialogElement) {
  this.open = true;
};
HTMLDialogElement.prototype.close ??= function (this: HTMLDialogElement) {
  this.open = false;
};

Element.prototype.scrollIntoView ??= () => {};

class QuietObserver {
  observe(): void {}
  unobserve(): void {}
  disconnect(): void {}
}
Object.assign(globalThis, { ResizeObserver: QuietObserver, IntersectionObserver: QuietObserver });
if (typeof globalThis.matchMedia !== 'function') {
  Object.assign(globalThis, {
    matchMedia: (query: string) => ({ matches: false, media: query, addEventListener() {}, removeEventListener() {}, addListener() {}, removeListener() {} }),
  });
}

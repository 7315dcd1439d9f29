/// How fast a run goes unless asked otherwise, in ticks per second: continuous time goes as the clock does.
const usual = 10;
const clock = 1000;
/** s: a tick this short is one of continuous time. */
const short = 0.01;

export function usualRate(family: string): number {
  return family === 'observer' ? clock : usual;
}

export function usualRateOf(document: { time?: unknown }): number {
  const dt = (document.time as { dt?: unknown } | undefined)?.dt;
  return typeof dt === 'number' && dt > 0 && dt < short ? Math.round(1 / dt) : usual;
}

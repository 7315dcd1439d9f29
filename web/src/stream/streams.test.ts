import { describe, expect, it } from 'vitest';
import type { SourceLike } from './client';
import type { StreamEvent } from './events';
import { Streams } from './streams';

describe('streams of a browser', () => {
  it('share one connection between equal wishes, and close it after the last', () => {
    const opened: { url: string; closed: boolean; say: (type: string, data: unknown) => void }[] = [];
    const streams = new Streams((url): SourceLike => {
      const handlers = new Map<string, (event: MessageEvent<string>) => void>();
      const one = { url, closed: false, say: (type: string, data: unknown) => handlers.get(type)?.({ data: JSON.stringify(data), lastEventId: '' } as MessageEvent<string>) };
      opened.push(one);
      return { addEventListener: (type, handler) => void handlers.set(type, handler), close: () => (one.closed = true) };
    });
    const first: StreamEvent[] = [];
    const second: StreamEvent[] = [];
    const stopFirst = streams.listen('3', 'overview', (event) => first.push(event));
    opened[0]!.say('hello', { epoch: 'e', run: '3', topic: 'overview', resumed: true, from: 1, head: 1, dt: 1, signals: [4] });
    opened[0]!.say('frame', { k: 9, t: 9, n: 1, v: [0] });
    const stopSecond = streams.listen('3', 'overview', (event) => second.push(event));
    expect(opened).toHaveLength(1);
    // Who comes later is told how things stand, and must fetch what was before.
    expect(second.map((event) => event.type)).toEqual(['state', 'hello']);
    expect(second[1]).toMatchObject({ hello: { signals: [4], resumed: false, from: 9 } });
    streams.listen('3', 'lane:drop', () => {});
    expect(opened.map((one) => one.url)).toEqual(['/api/v1/runs/3/stream?topic=overview', '/api/v1/runs/3/stream?topic=lane%3Adrop']);
    stopFirst();
    expect(opened[0]!.closed).toBe(false);
    stopSecond();
    expect(opened[0]!.closed).toBe(true);
    expect(opened[1]!.closed).toBe(false);
  });
});

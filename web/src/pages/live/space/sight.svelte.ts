/// How the space is seen, kept in the address: a copied link shows the same.
import { loop } from '../../../chart/loop';
import { readQuery, setQuery } from '../../../router/router.svelte';
import { dragged, parseTurn, turned, turnText, usualTurn, type Sight, type Turn } from './projection';

export const sights: readonly Sight[] = ['space', 'xy', 'xz', 'yz'];

export class SightState {
  sight = $state.raw<Sight>(sights.find((one) => one === readQuery('see')) ?? 'space');
  turn = $state.raw<Turn>(parseTurn(readQuery('turn')) ?? usualTurn);
  private hand: { x: number; y: number; from: Turn } | null = null;

  choose(sight: Sight): void {
    this.sight = sight;
    setQuery({ see: sight === 'space' ? null : sight });
    loop.invalidate();
  }

  back(): void {
    this.turnTo(usualTurn);
    this.keep();
  }

  grab(x: number, y: number): void {
    this.hand = { x, y, from: this.turn };
  }

  /** Whether a hand is on it. The address waits until it lets go. */
  drag(x: number, y: number): boolean {
    if (!this.hand) return false;
    this.turnTo(dragged(this.hand.from, x - this.hand.x, y - this.hand.y));
    return true;
  }

  release(): void {
    if (this.hand) this.keep();
    this.hand = null;
  }

  /** Answers whether the key turns the space. */
  key(key: string, far: boolean): boolean {
    if (this.sight !== 'space') return false;
    const by = far ? 15 : 5;
    const steps: Record<string, readonly [number, number]> = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, by], ArrowDown: [0, -by] };
    const step = steps[key];
    if (step) this.turnTo(turned(this.turn, step[0], step[1]));
    else if (key === 'Home') this.turnTo(usualTurn);
    else return false;
    this.keep();
    return true;
  }

  private turnTo(turn: Turn): void {
    this.turn = turn;
    loop.invalidate();
  }

  private keep(): void {
    setQuery({ turn: turnText(this.turn) });
  }
}

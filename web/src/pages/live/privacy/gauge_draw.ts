/// The index of every lane on one scale of five ranks: now, against other eavesdroppers, and as the paper prints it.
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { drawMark, nodeLook } from '../../../chart/marks';
import { formatNumber } from '../../../i18n/format.svelte';
import { gaugePlace, gaugeScale, rankBounds, rankEdges, type GaugeScale, type LaneReading, type PaperIndex } from './confidentiality';

export interface GaugeRow {
  reading: LaneReading;
  name: string;
  paper: PaperIndex | null;
}

/** px for numbers at the right. */
const right = 46;
const nameFont = '11px Inter, sans-serif';
const top = 26;
const bottom = 15;

const letters: Readonly<Record<string, string>> = { fusing: 'F', differencing: 'D', window_mean: 'W', zero: 'Z' };

export function letterOf(variant: string): string {
  return letters[variant] ?? (variant[0] ?? '').toUpperCase();
}

export function drawGauge(context: CanvasRenderingContext2D, width: number, height: number, rows: readonly GaugeRow[], ranks: readonly string[]): void {
  const scale = gaugeScale(rows.map(({ reading }) => reading));
  context.font = nameFont;
  const left = Math.min(0.34 * width, 24 + Math.max(0, ...rows.map(({ name }) => context.measureText(name).width)));
  const x = (index: number): number => left + gaugePlace(scale, index) * (width - left - right);
  drawRanks(context, height, ranks, scale, x);
  const each = (height - top - bottom) / Math.max(1, rows.length);
  rows.forEach((row, i) => drawRow(context, row, i, { y: top + (i + 0.5) * each, each, left, width, x }));
}

function drawRanks(context: CanvasRenderingContext2D, height: number, ranks: readonly string[], scale: GaugeScale, x: (value: number) => number): void {
  const edges = rankEdges(scale);
  context.textBaseline = 'alphabetic';
  ranks.forEach((rank, i) => {
    const [from, to] = [x(edges[i]!), x(edges[i + 1]!)];
    if (i % 2 === 0) {
      context.fillStyle = colour('grid');
      context.fillRect(from, top, to - from, height - top - bottom);
    }
    context.font = '10px Inter, sans-serif';
    context.fillStyle = colour('muted');
    context.textAlign = 'center';
    rank.split(' ').toReversed().forEach((word, line) => context.fillText(word, (from + to) / 2, top - 4 - 11 * line, to - from));
  });
  context.font = axisFont;
  for (const value of [...new Set([scale.lo, 0, ...rankBounds, scale.hi])]) {
    context.fillStyle = colour('muted');
    context.fillText(String(value), x(value), height - 3);
    context.strokeStyle = colour(value === 0 ? 'ink' : 'line');
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(Math.round(x(value)) + 0.5, top);
    context.lineTo(Math.round(x(value)) + 0.5, height - bottom);
    context.stroke();
  }
}

interface Place {
  y: number;
  each: number;
  left: number;
  width: number;
  x: (value: number) => number;
}

function drawRow(context: CanvasRenderingContext2D, { reading, name, paper }: GaugeRow, index: number, { y, each, left, width, x }: Place): void {
  const { lane, main, others } = reading;
  context.textBaseline = 'middle';
  context.textAlign = 'left';
  context.font = nameFont;
  context.fillStyle = colour('ink');
  context.fillText(name, 14, y, left - 22);
  const { shape } = nodeLook(index);
  context.fillStyle = colour(lane.token);
  context.strokeStyle = colour('surface');
  drawMark(context, shape, 6, y, 4.5);
  if (paper !== null) drawPaper(context, paper, y, Math.min(7, each / 2 - 1), { x, edge: width - right });
  for (const { variant, reading: other } of others) drawOther(context, letterOf(variant), x(other.value), y, lane.token);
  if (!main) return;
  context.fillStyle = colour(lane.token);
  context.strokeStyle = colour('surface');
  drawMark(context, shape, x(main.value), y, 5.5);
  context.font = "600 12px 'IBM Plex Mono', monospace";
  context.fillStyle = colour('ink');
  context.textAlign = 'right';
  context.fillText(formatNumber(main.value), width - 2, y);
}

function drawOther(context: CanvasRenderingContext2D, letter: string, at: number, y: number, token: string): void {
  context.beginPath();
  context.roundRect(at - 6, y - 6, 12, 12, 3);
  context.fillStyle = colour('surface');
  context.fill();
  context.strokeStyle = colour(token);
  context.lineWidth = 1.3;
  context.stroke();
  context.fillStyle = colour(token);
  context.font = "600 9px 'IBM Plex Mono', monospace";
  context.textAlign = 'center';
  context.fillText(letter, at, y + 0.5);
}

/** A tick where the paper's number is; where it says infinite an arrow out of the picture, and no number. */
function drawPaper(context: CanvasRenderingContext2D, paper: PaperIndex, y: number, half: number, { x, edge }: { x: (value: number) => number; edge: number }): void {
  context.strokeStyle = context.fillStyle = colour('ink');
  context.lineWidth = 2;
  context.beginPath();
  if (paper === 'infinite') {
    const from = edge - 24;
    context.moveTo(from, y);
    context.lineTo(edge - 2, y);
    context.stroke();
    context.beginPath();
    context.moveTo(edge + 4, y);
    context.lineTo(edge - 3, y - 4);
    context.lineTo(edge - 3, y + 4);
    context.fill();
    return;
  }
  const at = Math.round(x(paper));
  context.moveTo(at, y - half);
  context.lineTo(at, y + half);
  context.stroke();
}

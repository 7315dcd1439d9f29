/// The picture of a space: ground, stations, the true way, the estimates' ways, and where all of them are now.
import { colour } from '../../../chart/colours';
import { drawMark, type NodeLook } from '../../../chart/marks';
import { drawGround, drawPlaneGrid, type AxisWords } from './ground';
import { basisOf, Projection, type Box, type Margins, type Point, type Sight, type Turn } from './projection';
import { groundOf } from './space_box';
import { endOf, type Track } from './tracks';

export interface SpaceScene {
  stations: readonly { id: string; place: Point | null; token: string; attack: { letter: string; token: string } | null }[];
  links: readonly { from: string; to: string }[];
  truth: Track;
  estimates: readonly { id: string; look: NodeLook; track: Track; chosen: boolean }[];
  /** Tick up to which the ways are drawn. */
  at: number;
  words: AxisWords;
}

const around: Margins = { left: 38, right: 26, top: 20, bottom: 34 };
/** The frame of a plane, and within it the room that marks at the edge need. */
const frame: Margins = { left: 36, right: 6, top: 4, bottom: 20 };
const plain: Margins = { left: 52, right: 24, top: 22, bottom: 34 };

export function projectionOf(sight: Sight, turn: Turn, box: Box, width: number, height: number): Projection {
  const turning = sight === 'space';
  return new Projection(basisOf(sight, turn), box, width, height, turning ? around : plain, turning);
}

export function drawSpace(context: CanvasRenderingContext2D, p: Projection, sight: Sight, box: Box, scene: SpaceScene): void {
  const ground = groundOf(box);
  if (sight === 'space') drawGround(context, p, box, ground, scene.words);
  else drawPlaneGrid(context, p, frame, sight, scene.words);
  context.save();
  context.beginPath();
  if (sight === 'space') context.rect(0, 0, p.width, p.height);
  else context.rect(frame.left, frame.top, p.width - frame.left - frame.right, p.height - frame.top - frame.bottom);
  context.clip();
  links(context, p, scene);
  shadow(context, p, scene, ground, sight);
  drops(context, p, scene, ground);
  for (const one of scene.estimates) way(context, p, one.track, { token: one.look.token, width: one.chosen ? 2.2 : 1.2, alpha: one.chosen ? 1 : 0.75, dash: [] });
  way(context, p, scene.truth, { token: 'ink', width: 2.2, alpha: 1, dash: [6, 4] });
  stations(context, p, scene);
  heads(context, p, scene);
  context.restore();
}

function way(context: CanvasRenderingContext2D, p: Projection, track: Track, look: { token: string; width: number; alpha: number; dash: readonly number[] }): void {
  context.strokeStyle = colour(look.token);
  context.globalAlpha = look.alpha;
  context.lineWidth = look.width;
  context.lineJoin = 'round';
  context.setLineDash([...look.dash]);
  context.beginPath();
  let pen = false;
  for (let i = 0; i < track.length; i++) {
    const x = track.x[i]!;
    const y = track.y[i]!;
    const z = track.z[i]!;
    if (!Number.isFinite(x + y + z)) {
      pen = false;
      continue;
    }
    if (pen && track.joined[i]) context.lineTo(p.x(x, y, z), p.y(x, y, z));
    else context.moveTo(p.x(x, y, z), p.y(x, y, z));
    pen = true;
  }
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

/** The true way on the ground below it: without it a parallel projection does not tell height from distance. */
function shadow(context: CanvasRenderingContext2D, p: Projection, { truth, at }: SpaceScene, ground: number, sight: Sight): void {
  if (sight !== 'space') return;
  context.strokeStyle = colour('control');
  context.lineWidth = 1;
  context.beginPath();
  for (let i = 0; i < truth.length; i++) {
    const x = truth.x[i]!;
    const y = truth.y[i]!;
    if (i && truth.joined[i]) context.lineTo(p.x(x, y, ground), p.y(x, y, ground));
    else context.moveTo(p.x(x, y, ground), p.y(x, y, ground));
  }
  const now = endOf(truth, at);
  if (now) drop(context, p, now, ground);
  context.stroke();
}

function drop(context: CanvasRenderingContext2D, p: Projection, [x, y, z]: Point, ground: number): void {
  if (z === ground) return;
  context.moveTo(p.x(x, y, z), p.y(x, y, z));
  context.lineTo(p.x(x, y, ground), p.y(x, y, ground));
}

function drops(context: CanvasRenderingContext2D, p: Projection, scene: SpaceScene, ground: number): void {
  context.strokeStyle = colour('control');
  context.lineWidth = 1;
  context.beginPath();
  for (const { place } of scene.stations) if (place) drop(context, p, place, ground);
  context.stroke();
}

function links(context: CanvasRenderingContext2D, p: Projection, scene: SpaceScene): void {
  context.strokeStyle = colour('line');
  context.lineWidth = 1;
  context.beginPath();
  for (const { from, to } of scene.links) {
    const a = scene.stations.find((station) => station.id === from)?.place;
    const b = scene.stations.find((station) => station.id === to)?.place;
    if (!a || !b) continue;
    context.moveTo(p.x(...a), p.y(...a));
    context.lineTo(p.x(...b), p.y(...b));
  }
  context.stroke();
}

function stations(context: CanvasRenderingContext2D, p: Projection, scene: SpaceScene): void {
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const { id, place, token, attack } of scene.stations) {
    if (!place) continue;
    const [x, y] = [p.x(...place), p.y(...place)];
    context.beginPath();
    context.arc(x, y, id.length > 1 ? 10.5 : 9, 0, 2 * Math.PI);
    context.fillStyle = colour('surface');
    context.fill();
    context.lineWidth = attack ? 2.4 : 1.6;
    context.strokeStyle = colour(attack ? attack.token : token);
    context.stroke();
    context.fillStyle = colour('ink');
    context.font = "600 11px 'IBM Plex Mono', monospace";
    context.fillText(id, x, y + 0.5);
    if (attack) badge(context, x + 13, y - 11, attack);
  }
}

function badge(context: CanvasRenderingContext2D, x: number, y: number, { letter, token }: { letter: string; token: string }): void {
  const half = letter.length > 1 ? 8.5 : 6.5;
  context.beginPath();
  context.roundRect(x - half, y - 6.5, 2 * half, 13, 2.5);
  context.fillStyle = colour(token);
  context.fill();
  context.fillStyle = colour('surface');
  context.font = "600 9.5px 'IBM Plex Mono', monospace";
  context.fillText(letter, x, y + 0.5);
}

/** Where everything is now. Estimates that agree lie on each other: their numbers stand around, each on a side of its own. */
function heads(context: CanvasRenderingContext2D, p: Projection, scene: SpaceScene): void {
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  const count = scene.estimates.length;
  scene.estimates.forEach(({ id, look, track, chosen }, i) => {
    const now = endOf(track, scene.at);
    if (!now) return;
    const [x, y] = [p.x(...now), p.y(...now)];
    context.fillStyle = colour(look.token);
    context.strokeStyle = colour('surface');
    drawMark(context, look.shape, x, y, chosen ? 6 : 4.5);
    const angle = (2 * Math.PI * (i + 0.5)) / count - Math.PI / 2;
    context.font = "600 10.5px 'IBM Plex Mono', monospace";
    context.lineWidth = 3;
    const [lx, ly] = [x + 14 * Math.cos(angle), y + 14 * Math.sin(angle)];
    context.strokeText(id, lx, ly);
    context.fillText(id, lx, ly);
  });
  const truth = endOf(scene.truth, scene.at);
  if (!truth) return;
  context.beginPath();
  context.arc(p.x(...truth), p.y(...truth), 7, 0, 2 * Math.PI);
  context.lineWidth = 2.2;
  context.strokeStyle = colour('ink');
  context.stroke();
}

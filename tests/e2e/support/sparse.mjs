// What the tests know of the sparse family: its stations, the letters of its attacks, and where its panels stand.
import { call } from './server.mjs';

export const stations = ['1', '2', '3', '4', '5'];
export const channels = ['range', 'azimuth', 'elevation', 'vx', 'vy', 'vz'];
export const letters = { 0: '', 1: 'D', 2: 'F', 3: 'R', 4: 'I', 5: 'II', 6: 'R' };

export const panel = (page, title) => page.getByRole('region', { name: title, exact: true });

/** Every tick of some signals, by name. */
export async function everyTick(server, run, names, to) {
  const { k, series } = await call(server, 'GET', `/runs/${run}/samples?signals=${names.join()}&from=0&to=${to}&points=${to + 2}`);
  return { k, of: Object.fromEntries(series.map(({ signal, v }) => [signal, v])) };
}

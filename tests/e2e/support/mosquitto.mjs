// A broker of MQTT on a free port, and messages to it.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { existsSync, writeFileSync } from 'node:fs';
import { connect, createServer } from 'node:net';
import { join } from 'node:path';
import { folder, until } from './server.mjs';

const program = ['/usr/sbin/mosquitto', '/usr/bin/mosquitto', '/usr/local/sbin/mosquitto'].find(existsSync);
export const without = program ? false : 'mosquitto is not installed';

async function freePort() {
  const server = createServer().listen(0, '127.0.0.1');
  await once(server, 'listening');
  const { port } = server.address();
  server.close();
  await once(server, 'close');
  return port;
}

const answers = (port) =>
  new Promise((resolve) => {
    const socket = connect(port, '127.0.0.1');
    socket.once('connect', () => resolve(socket.end() && true));
    socket.once('error', () => resolve(false));
  });

export async function startMosquitto() {
  const place = folder();
  const port = await freePort();
  const file = join(place.path, 'broker.conf');
  writeFileSync(file, `listener ${port} 127.0.0.1\nallow_anonymous true\n`);
  const child = spawn(program, ['-c', file], { stdio: 'ignore' });
  const ended = once(child, 'exit');
  await until('the broker answers', () => answers(port));
  return {
    url: `tcp://127.0.0.1:${port}`,
    publish: (topic, text) => publish(port, topic, text),
    stop: async () => {
      child.kill();
      await ended;
      place.remove();
    },
  };
}

const words = (text) => {
  const bytes = Buffer.from(text);
  return Buffer.concat([Buffer.from([bytes.length >> 8, bytes.length & 255]), bytes]);
};

/** A packet of MQTT 3.1.1 with less than 128 bytes in it. */
const packet = (kind, ...parts) => {
  const body = Buffer.concat(parts);
  return Buffer.concat([Buffer.from([kind, body.length]), body]);
};

/** One message at QoS 1, until the broker has it. */
async function publish(port, topic, text) {
  const socket = connect(port, '127.0.0.1');
  const [connection, keepAlive] = [Buffer.from([4, 2]), Buffer.from([0, 60])];
  socket.write(packet(0x10, words('MQTT'), connection, keepAlive, words('')));
  await once(socket, 'data');
  socket.write(packet(0x32, words(topic), Buffer.from([0, 1]), Buffer.from(text)));
  await once(socket, 'data');
  socket.end(packet(0xe0));
}

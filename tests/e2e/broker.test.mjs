// A plant that speaks MQTT, from the page: the run's name there, whose clock counts, what came and what could not be used.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openBrowser, openPage } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { startMosquitto, without } from './support/mosquitto.mjs';
import { counted } from './support/said.mjs';
import { call, startServer, until } from './support/server.mjs';
import { panel } from './support/sparse.mjs';

describe('a plant behind a broker', { skip: without }, () => {
  let broker;
  let server;
  let browser;
  before(async () => {
    broker = await startMosquitto();
    server = await startServer({ options: ['--no-demo', '--mqtt', broker.url, '--mqtt-topic', 'plant/{run}/rows'] });
    browser = await openBrowser();
  });
  after(async () => {
    await browser?.close();
    await server?.stop();
    await broker?.stop();
  });

  async function openForm(lang) {
    const view = await openPage(browser, server, { lang });
    await view.goto('/scenarios/consensus');
    await view.page.locator('select:has(option[value=ingest])').selectOption('ingest');
    await view.page.getByText('plant/{run}/rows').waitFor();
    return view;
  }

  test('a name in its topics leads messages into the run; what is garbage is told', async () => {
    const view = await openForm('en');
    const { page } = view;
    const name = page.getByRole('textbox', { name: 'Name there' });
    assert.equal(await page.getByRole('combobox', { name: 'Tick' }).count(), 0, 'of whom, without a name?');
    await name.fill('line/1');
    await page.getByText('One level of a topic').waitFor();
    assert.equal(await name.getAttribute('aria-invalid'), 'true');
    await button(page, 'Run').click();
    assert.deepEqual((await call(server, 'GET', '/runs')).items, [], 'no run of such a name');
    await name.fill('line1');
    await page.getByRole('combobox', { name: 'Tick' }).selectOption('messages say k');
    await button(page, 'Run').click();
    await page.waitForURL(/\/live\/\d+/);
    const id = /\/live\/(\d+)/.exec(page.url())[1];
    const { input } = await call(server, 'GET', `/runs/${id}`);
    assert.deepEqual(input.ingest.mqtt, { name: 'line1', clock: 'k' });

    const readings = panel(page, 'Readings');
    await readings.getByText(`this run is line1 or ${id}`).waitFor();
    await until('the server listens', async () => (await call(server, 'GET', '/ingest')).broker.connected);
    await broker.publish('plant/line1/rows', '{"k":1,"node":"1","values":{"p":512.5,"q":80}}');
    await broker.publish(`plant/${id}/rows`, '{"k":1,"node":"2","values":{"p":500}}');
    await broker.publish('plant/line1/rows', 'no row');
    await readings.locator('dl div', { hasText: 'accepted' }).getByText('2', { exact: true }).waitFor();
    await readings.getByText('Messages that could not be used: 1').click();
    await counted(readings.locator('details p', { hasText: 'plant/line1/rows' }), 1);
    await view.close();
  });

  test('nothing for axe to say', async () => {
    const view = await openForm('zh');
    await view.page.getByRole('textbox', { name: '主题中名称' }).fill('线路');
    await checkAxe(view.page, 'the form, zh');
    await view.close();
  });
});

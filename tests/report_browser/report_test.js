// The report in a real browser: what a reader sees and does.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const complaints = [], requests = [];
let browser, page;

before(async () => {
  browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
  page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('request', (request) => requests.push(request.url()));
  await page.goto(pathToFileURL('report.html').href);
});
after(() => browser?.close());

const column = (table, i) => table.locator('tbody tr').evaluateAll(
  (rows, cell) => rows.map((row) => Number.parseFloat(row.cells[cell].dataset.v ?? row.cells[cell].textContent)), i);

test('a click on a head sorts the table by it, another one the other way', async () => {
  const table = page.locator('#s0-table-times table'), head = table.locator('thead th').nth(1);
  const before = await column(table, 1);
  assert.equal(before.length, 3);
  const up = [...before].sort((a, b) => a - b);
  await head.click();
  assert.deepEqual(await column(table, 1), up);
  await head.click();
  assert.deepEqual(await column(table, 1), [...up].reverse());
  await table.locator('thead th').first().press('Enter');
  assert.deepEqual(await column(table, 0), [4, 8, 16]);
});

test('plots are drawn, every figure with its interval', async () => {
  const plots = page.locator('figure.plot svg');
  assert.equal(await plots.count(), 2);
  for (const plot of await plots.all()) {
    const { width, height } = await plot.boundingBox();
    assert.ok(width > 200 && height > 100, `${width} x ${height}`);
  }
  for (const mark of await page.locator('#s0-plot-times rect').all()) {
    const { width, height } = await mark.boundingBox();
    assert.ok(width > 2 && height > 2, `${width} x ${height}`);
  }
  assert.equal(await page.locator('#s0-plot-times rect').count(), 6);
  assert.ok(await page.locator('#s0-plot-times .whisker').count() >= 3 * 4);
});

test('a series disappears at a click in the legend, and comes back', async () => {
  const plot = page.locator('#s0-plot-tests'), button = plot.locator('.legend button').first();
  const series = plot.locator('g[data-series="0"]');
  await button.click();
  assert.equal(await series.isVisible(), false);
  await button.click();
  assert.equal(await series.isVisible(), true);
});

test('claims can be filtered by verdict', async () => {
  const claim = page.locator('#s0-claim-later'), button = page.locator('.tally button[data-verdict="not-run"]');
  assert.equal(await claim.isVisible(), true);
  await button.click();
  assert.equal(await claim.isVisible(), false);
  assert.equal(await page.locator('#s0-claim-same').isVisible(), true);
  await button.click();
});

test('two pictures lie over each other, cut where the slider is', async () => {
  const stage = page.locator('.compare .stage'), slider = page.locator('.compare input');
  await stage.scrollIntoViewIfNeeded();
  const loaded = await stage.locator('img').evaluateAll((images) => images.map((image) => image.naturalWidth));
  assert.ok(loaded.length === 2 && loaded.every((width) => width > 0), `${loaded}`);
  const sources = await stage.locator('img').evaluateAll((images) => images.map((image) => image.src));
  assert.notEqual(sources[0], sources[1]);
  const shown = () => stage.locator('img').last().evaluate((image) => getComputedStyle(image).clipPath);
  await slider.fill('25');
  const first = await shown();
  await slider.fill('75');
  assert.notEqual(first, await shown());
  await page.locator('.compare select').last().selectOption('0');
  const other = await stage.locator('img').last().getAttribute('src');
  assert.notEqual(other, sources[1]);
});

test('on a telephone nothing is wider than the screen', async () => {
  await page.setViewportSize({ width: 380, height: 800 });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 380);
});

test('nothing went wrong, and nothing was asked of the network', () => {
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests.filter((url) => !/^(file|data):/.test(url)), []);
});

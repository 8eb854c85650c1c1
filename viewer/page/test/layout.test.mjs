// The page on large and small screens, in light and dark, and by keyboard alone.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { close, eventually, inspect, launch, open, Program, screenshot } from './harness.mjs';

let browser;
let program;
let url;
before(async () => {
  browser = await launch();
  program = new Program(['demo', '--fingers', '--seconds', '600', '--view', '0']);
  url = await program.url();
});
after(async () => {
  await program.stop();
  await browser.close();
});

for (const { name, options } of [
  { name: 'wide_light', options: { viewport: { width: 1280, height: 720 }, colorScheme: 'light' } },
  { name: 'wide_dark', options: { viewport: { width: 1280, height: 720 }, colorScheme: 'dark' } },
  { name: 'narrow_light', options: { viewport: { width: 390, height: 844 }, colorScheme: 'light' } },
  { name: 'narrow_dark', options: { viewport: { width: 390, height: 844 }, colorScheme: 'dark', reducedMotion: 'reduce' } },
]) {
  test(`nothing is cut off: ${name}`, async () => {
    const page = await open(browser, url, options);
    await eventually(async () => (await inspect(page)).frame);
    await screenshot(page, name);
    const { width } = options.viewport;
    const beyond = await page.evaluate((limit) => [...document.querySelectorAll('button, input, select, label, dl, canvas, h1')]
      .filter((element) => element.getBoundingClientRect().right > limit + 0.5 || element.getBoundingClientRect().left < -0.5)
      .map((element) => element.id || element.textContent), width);
    assert.deepEqual(beyond, []);
    const canvas = await page.locator('#canvas').boundingBox();
    assert.ok(canvas.width > 0.6 * Math.min(width, 900) && canvas.height > 240);
    await close(page);
  });
}

test('nothing moves by itself for who wants less motion', async () => {
  const durations = async (reducedMotion) => {
    const page = await open(browser, url, { reducedMotion });
    const all = await page.evaluate(() => [...document.querySelectorAll('*')].flatMap((element) => {
      const { transitionDuration, animationDuration, scrollBehavior } = getComputedStyle(element);
      return [transitionDuration, animationDuration, scrollBehavior];
    }));
    await close(page);
    return [...new Set(all)].sort();
  };
  assert.deepEqual(await durations('reduce'), ['0s', 'auto']);
  assert.deepEqual(await durations('no-preference'), ['0.12s', '0s', 'auto']);
});

// N and P go through all that a click can pick, F goes near, and Escape leaves it.
async function picksByKey(page) {
  const names = await page.evaluate(() => window.glissade.page.stage.coarse.group.children
    .filter((node) => node.visible).map((node) => node.userData.name));
  assert.ok(names.length > 5, `${names}`);
  const tellsOf = async (key, name) => {
    await page.keyboard.press(key);
    await eventually(async () => (await page.locator('#picked dt').first().textContent()) === name, () => `${key}: ${name}`);
    assert.equal(await page.locator('#object').isVisible(), true);
  };
  const distance = () => page.evaluate(() => {
    const { camera, controls } = window.glissade.page.stage.eye;
    return camera.position.distanceTo(controls.target);
  });
  await page.keyboard.press('f');
  const ofScene = await distance();
  await tellsOf('n', names[0]);
  await tellsOf('n', names[1]);
  await tellsOf('p', names[0]);
  await tellsOf('p', names.at(-1));
  await page.keyboard.press('f');
  assert.ok((await distance()) < 0.5 * ofScene, 'a segment of a hand is small');
  await tellsOf('n', names[0]);
  await page.keyboard.press('Escape');
  await eventually(async () => page.locator('#object').isHidden());
  await tellsOf('p', names.at(-1));
  await page.keyboard.press('Escape');
  await page.keyboard.press('f');
  assert.ok(Math.abs((await distance()) - ofScene) < 1e-3 * ofScene, 'the whole scene again');
}

test('a control keeps only the keys that it needs', async () => {
  const page = await open(browser, url);
  await eventually(async () => (await inspect(page)).frame);
  const isShown = (what) => page.locator(`#show-${what}`).isChecked();
  const isLive = async () => (await inspect(page)).isLive;
  await page.locator('#view-front').click();
  await page.keyboard.press('e');
  assert.equal(await isShown('edges'), false, 'after a click on a button');
  await page.keyboard.press(' ');
  assert.equal(await isLive(), true, 'space presses the button that has the focus');
  await page.locator('#show-ghosts').click();
  await page.keyboard.press('c');
  assert.equal(await isShown('contacts'), false, 'after a click on a checkbox');
  await page.keyboard.press(' ');
  assert.deepEqual([await isShown('ghosts'), await isLive()], [true, true]);
  await page.locator('#section-axis').focus();
  await page.keyboard.press('g');
  assert.equal(await isShown('ghosts'), true, 'a letter chooses of the list');
  await page.locator('#time').focus();
  const camera = () => page.evaluate(() => window.glissade.page.stage.camera.position.toArray());
  const place = await camera();
  await page.keyboard.press('ArrowLeft');
  assert.deepEqual(await camera(), place, 'an arrow moves the slider');
  await eventually(async () => !(await isLive()));
  await page.keyboard.press('l');
  await eventually(isLive);
  await close(page);
});

test('everything works by keyboard alone', async () => {
  const page = await open(browser, url);
  await eventually(async () => (await inspect(page)).frames > 5);
  const camera = () => page.evaluate(() => window.glissade.page.stage.camera.position.toArray());
  const start = await camera();
  await page.keyboard.press('ArrowLeft');
  const turned = await camera();
  assert.notDeepEqual(turned, start);
  await page.keyboard.press('5');
  assert.notDeepEqual(await camera(), turned);
  await page.keyboard.press('+');
  await page.keyboard.press(' ');
  const chosen = () => page.evaluate(() => window.glissade.page.timeline.frame.sequence);
  const paused = await chosen();
  await page.keyboard.press(',');
  assert.ok((await chosen()) < paused);
  await eventually(async () => (await inspect(page)).frame.sequence < paused);
  await page.keyboard.press('l');
  await eventually(async () => (await inspect(page)).isLive);
  await page.keyboard.press('g');
  assert.equal(await page.locator('#show-ghosts').isChecked(), false);
  await page.keyboard.press('G'); // with Caps Lock
  assert.equal(await page.locator('#show-ghosts').isChecked(), true);
  await picksByKey(page);
  // Every control can be reached, and shows that it is.
  const reached = new Set();
  for (let i = 0; i < 40; ++i) {
    await page.keyboard.press('Tab');
    const { id, outline } = await page.evaluate(() => ({
      id: document.activeElement.id, outline: getComputedStyle(document.activeElement).outlineStyle,
    }));
    if (id) {
      assert.notEqual(outline, 'none', id);
      reached.add(id);
    }
  }
  for (const id of ['canvas', 'view-front', 'fit', 'show-forces', 'section-axis', 'back', 'play', 'forward', 'time', 'live'])
    assert.ok(reached.has(id), `${id} is not reached by the Tab key: ${[...reached]}`);
  await page.locator('#section-axis').selectOption('0');
  assert.equal(await page.evaluate(() => window.glissade.page.stage.renderer.clippingPlanes.length), 1);
  await close(page);
});

test('an object that is picked tells of itself', async () => {
  const page = await open(browser, url);
  await eventually(async () => (await inspect(page)).frame);
  const at = await page.evaluate(() => {
    const { stage } = window.glissade.page;
    const node = stage.coarse.parts.get(0);
    const place = stage.box.getCenter(node.position.clone());
    return place.project(stage.camera).toArray();
  });
  const canvas = await page.locator('#canvas').boundingBox();
  await page.mouse.click(canvas.x + ((at[0] + 1) / 2) * canvas.width, canvas.y + ((1 - at[1]) / 2) * canvas.height);
  await eventually(async () => page.locator('#object').isVisible());
  assert.match(await page.locator('#picked').textContent(), /triangles/);
  await close(page);
});

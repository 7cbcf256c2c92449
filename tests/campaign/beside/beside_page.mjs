// The page of beside.mjs: shows original and made in one viewer each, under the viewer's own neutral light, from ten
// directions, compares the pictures, and posts a sheet an asset and the figures.
const size = 512, shown = 320;  // pixels
const fieldOfView = 30;         // degrees
const background = [128, 128, 128];
const directions = Array.from({ length: 10 }, (_, i) => [36 * i, i % 2 ? 112 : 62]);  // azimuth, from the zenith

const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));

/// Scripts of the page may not be told that a model failed but by events.
function loaded(viewer, source) {
  return new Promise((resolve, reject) => {
    viewer.addEventListener('load', resolve, { once: true });
    viewer.addEventListener('error', (event) =>
      reject(new Error(`${source}: ${event.detail?.sourceError?.message ?? event.detail?.type}`)), { once: true });
    viewer.src = source;
  });
}

async function show(source) {
  const viewer = document.createElement('model-viewer');
  for (const [name, value] of Object.entries({
    'environment-image': 'neutral', 'tone-mapping': 'neutral', 'shadow-intensity': '0', 'interaction-prompt': 'none',
    'interpolation-decay': '1', loading: 'eager', reveal: 'auto',
    'min-field-of-view': '1deg', 'max-field-of-view': '90deg' }))
    viewer.setAttribute(name, value);
  document.body.append(viewer);
  await loaded(viewer, source);
  return viewer;
}

/// What both are framed by: the box of the original.
function frameOf(viewer) {
  const middle = viewer.getBoundingBoxCenter(), box = viewer.getDimensions();
  const radius = Math.hypot(box.x, box.y, box.z) / 2;
  return { target: `${middle.x}m ${middle.y}m ${middle.z}m`,
           distance: 1.02 * radius / Math.sin(fieldOfView / 2 * Math.PI / 180) };
}

async function photograph(viewer, { target, distance }, [azimuth, polar]) {
  viewer.maxCameraOrbit = `auto 180deg ${distance}m`;  // near and far planes follow it
  viewer.minCameraOrbit = `auto 0deg ${distance}m`;
  viewer.cameraTarget = target;
  viewer.fieldOfView = `${fieldOfView}deg`;
  viewer.cameraOrbit = `${azimuth}deg ${polar}deg ${distance}m`;
  await viewer.updateComplete;
  viewer.jumpCameraToGoal();
  for (let i = 0; i < 3; ++i) await frame();
  if (Math.abs(viewer.getCameraOrbit().radius / distance - 1) > 1e-3) throw new Error('the camera did not move');
  const bitmap = await createImageBitmap(await viewer.toBlob({ mimeType: 'image/png', idealAspect: false }));
  const canvas = new OffscreenCanvas(size, size), context = canvas.getContext('2d');
  context.drawImage(bitmap, 0, 0, size, size);
  return context.getImageData(0, 0, size, size);
}

/// How much they differ: on the background, where either shows something, where both do.
function compare(a, b) {
  const difference = new ImageData(size, size);
  let all = 0, within = 0, shared = 0, pixels = 0, sharedPixels = 0, brighter = 0;
  for (let i = 0; i < a.data.length; i += 4) {
    const is = a.data[i + 3] + b.data[i + 3] > 0;
    const both = a.data[i + 3] + b.data[i + 3] === 510;
    pixels += is, sharedPixels += both;
    for (let k = 0; k < 3; ++k) {
      const on = (image) => background[k] + (image.data[i + k] - background[k]) * image.data[i + 3] / 255;
      const off = on(b) - on(a);
      all += off * off;
      if (is) within += off * off;
      if (both) shared += off * off, brighter += off;
      difference.data[i + k] = Math.min(255, 2 * Math.abs(off));
    }
    difference.data[i + 3] = 255;
  }
  const decibels = (sum, count) => 10 * Math.log10(255 * 255 / Math.max(sum / (3 * count), 1e-3));
  return { difference, psnr: decibels(all, size * size), psnrWithout: decibels(within, Math.max(pixels, 1)),
           psnrShared: decibels(shared, Math.max(sharedPixels, 1)),
           brighter: brighter / (3 * Math.max(sharedPixels, 1)), share: pixels / (size * size) };
}

/// Three rows a direction: the original, what was made, twice their difference; five directions beside each other.
class Sheet {
  constructor() {
    this.canvas = new OffscreenCanvas(5 * shown, 6 * shown);
    this.context = this.canvas.getContext('2d');
    this.context.fillStyle = `rgb(${background})`;
    this.context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    this.context.font = '14px sans-serif';
  }
  async add(i, images, words) {
    const x = i % 5 * shown, top = Math.floor(i / 5) * 3 * shown;
    for (const [row, image] of images.entries())
      this.context.drawImage(await createImageBitmap(image), x, top + row * shown, shown, shown);
    this.context.fillStyle = 'white';
    this.context.fillText(words, x + 6, top + 2 * shown + 18);
  }
  bytes() { return this.canvas.convertToBlob({ type: 'image/png' }); }
}

/// Pictures from all directions, and what frames them: the box of the model itself unless another is given. One viewer at
/// a time: those out of sight do not draw.
async function photographs(source, given) {
  const viewer = await show(source);
  try {
    const framed = given ?? frameOf(viewer), pictures = [];
    for (const direction of directions) pictures.push(await photograph(viewer, framed, direction));
    return { framed, pictures };
  } finally {
    viewer.remove();
  }
}

async function beside({ name, original, made }) {
  const before = await photographs(`/${original}`), after = await photographs(`/${made}`, before.framed);
  const sheet = new Sheet(), views = [];
  for (const i of directions.keys()) {
    const [a, b] = [before.pictures[i], after.pictures[i]];
    const { difference, ...figures } = compare(a, b);
    if (figures.share === 0) throw new Error('the browser shows nothing');
    views.push(figures);
    await sheet.add(i, [a, b, difference], `${figures.psnr.toFixed(1)} dB, ${figures.psnrWithout.toFixed(1)} without background`);
  }
  await fetch(`/${name}.png`, { method: 'POST', body: await sheet.bytes() });
  return { name, views };
}

const report = { assets: [] };
try {
  const job = await (await fetch('/job')).json();
  customElements.get('model-viewer').minimumRenderScale = 1;  // no coarser picture where the machine is slow
  for (const asset of job.assets) {
    try {
      report.assets.push(await beside(asset));
    } catch (error) {
      report.assets.push({ name: asset.name, error: String(error) });
    }
  }
} catch (error) {
  report.error = String(error?.stack ?? error);
}
await fetch('/done', { method: 'POST', body: JSON.stringify(report) });

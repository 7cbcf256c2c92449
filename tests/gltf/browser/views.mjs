// Renders the models of a job from six sides, without light, and compares pictures.
//
// A model is shown by its own texture coordinates ("uv") or by its rays ("rays"): the direction that
// the map gives a point of the surface, linear on triangles, from the morph target "sphere" or, of
// an exported sphere, from the positions; the texture is then looked up per pixel by θ and ϕ.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';

const sides = [[1, 0, 0], [-1, 0, 0], [0, 1, 0.001], [0, -1, 0.001], [0, 0, 1], [0, 0, -1]];

const raysVertex = `
  attribute vec3 ray;
  varying vec3 direction;
  void main() {
    direction = ray;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;
const anglesFragment = `
  varying vec3 direction;
  uniform sampler2D map;
  const float pi = 3.14159265358979;
  vec2 uv() {  // y is up: θ from x towards −z
    vec3 d = normalize(direction);
    float theta = atan(-d.z, d.x);
    return vec2(fract(theta / (2.0 * pi)), acos(clamp(d.y, -1.0, 1.0)) / pi);
  }`;
const raysFragment = anglesFragment + `
  void main() {
    gl_FragColor = textureLod(map, uv(), 0.0);
    #include <colorspace_fragment>
  }`;
// red: within 4° of the date line; green: within 20° of a pole
const regionFragment = anglesFragment + `
  void main() {
    vec2 at = uv();
    float seam = min(at.x, 1.0 - at.x) < 4.0 / 360.0 ? 1.0 : 0.0;
    float pole = min(at.y, 1.0 - at.y) < 20.0 / 180.0 ? 1.0 : 0.0;
    gl_FragColor = vec4(seam, pole, 0.0, 1.0);
  }`;

const canvas = document.createElement('canvas');
const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true });

async function bytesOf(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return response.arrayBuffer();
}

async function loadTexture(url, flipY) {
  const texture = await new THREE.TextureLoader().loadAsync(url);
  texture.flipY = flipY;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.wrapS = THREE.RepeatWrapping;
  return texture;
}

async function load(model) {
  const url = `/files/${model.file}`;
  if (model.file.endsWith('.obj')) {
    const text = new TextDecoder().decode(await bytesOf(url));
    const object = new OBJLoader().parse(text);
    const map = await loadTexture(`/files/${model.texture}`, true);
    object.traverse((node) => { if (node.isMesh) node.material = new THREE.MeshBasicMaterial({ map }); });
    return object;
  }
  const gltf = await new GLTFLoader().loadAsync(url);
  return gltf.scene;
}

function meshes(object) {
  const found = [];
  object.updateMatrixWorld(true);
  object.traverse((node) => { if (node.isMesh) found.push(node); });
  return found;
}

/// Rays at the vertices: of the sphere that the mesh morphs into, or of the mesh itself.
function raysOf(geometry) {
  const position = geometry.attributes.position;
  const delta = geometry.morphAttributes.position?.[0];
  const rays = new Float32Array(3 * position.count);
  const box = new THREE.Box3();
  const point = new THREE.Vector3(), change = new THREE.Vector3();
  for (let pass = 0; pass < 2; ++pass) {
    const middle = box.getCenter(new THREE.Vector3());
    for (let i = 0; i < position.count; ++i) {
      point.fromBufferAttribute(position, i);
      if (delta) point.add(change.fromBufferAttribute(delta, i));
      if (pass === 0) box.expandByPoint(point);
      else point.sub(middle).toArray(rays, 3 * i);
    }
  }
  return new THREE.BufferAttribute(rays, 3);
}

function prepare(object, model) {
  for (const mesh of meshes(object)) {
    const map = mesh.material.map;
    map.anisotropy = model.anisotropy ?? 1;
    if (model.filter === 'linear') {
      map.minFilter = map.magFilter = THREE.LinearFilter;
      map.generateMipmaps = false;
      map.needsUpdate = true;
    }
    if (model.mode === 'rays' || model.mode === 'region') {
      mesh.geometry.setAttribute('ray', raysOf(mesh.geometry));
      mesh.material = new THREE.ShaderMaterial({
        vertexShader: raysVertex,
        fragmentShader: model.mode === 'rays' ? raysFragment : regionFragment,
        uniforms: { map: { value: map } },
      });
      mesh.geometry.morphAttributes = {};
    } else {
      mesh.material = new THREE.MeshBasicMaterial({ map, vertexColors: mesh.material.vertexColors });
    }
  }
}

function picture(object, side, size) {
  renderer.setSize(size, size, false);
  renderer.setClearColor(0x000000, 0);
  const box = new THREE.Box3().setFromObject(object, true);
  const middle = box.getCenter(new THREE.Vector3());
  const radius = 0.5 * box.getSize(new THREE.Vector3()).length();
  const camera = new THREE.OrthographicCamera(-radius, radius, radius, -radius, 0, 4 * radius);
  camera.position.copy(middle).addScaledVector(new THREE.Vector3(...side).normalize(), 2 * radius);
  camera.lookAt(middle);
  const scene = new THREE.Scene();
  scene.add(object);
  renderer.render(scene, camera);
  const pixels = new Uint8Array(4 * size * size);
  renderer.getContext().readPixels(0, 0, size, size, 6408, 5121, pixels);
  return pixels;
}

function statistics(object) {
  const result = { vertices: 0, triangles: 0, uv: [1e9, -1e9, 1e9, -1e9] };
  const box = new THREE.Box3().setFromObject(object, true);
  for (const { geometry } of meshes(object)) {
    result.vertices += geometry.attributes.position.count;
    result.triangles += (geometry.index ?? geometry.attributes.position).count / 3;
    const uv = geometry.attributes.uv;
    for (let i = 0; i < uv.count; ++i) {
      result.uv = [Math.min(result.uv[0], uv.getX(i)), Math.max(result.uv[1], uv.getX(i)),
                   Math.min(result.uv[2], uv.getY(i)), Math.max(result.uv[3], uv.getY(i))];
    }
  }
  return { ...result, min: box.min.toArray(), max: box.max.toArray() };
}

function psnr(a, b) {
  let sum = 0, count = 0;
  for (let i = 0; i < a.length; i += 4) {
    if (a[i + 3] === 0 && b[i + 3] === 0) continue;
    for (let k = 0; k < 3; ++k) sum += (a[i + k] - b[i + k]) ** 2;
    count += 3;
  }
  return { squares: sum, samples: count };
}

/// Mean difference and share of clearly different pixels: at the date line, at the poles, elsewhere.
function differences(a, b, region) {
  const result = { seam: [0, 0, 0], pole: [0, 0, 0], rest: [0, 0, 0] };
  for (let i = 0; i < a.length; i += 4) {
    if (a[i + 3] === 0 || b[i + 3] === 0 || region[i + 3] === 0) continue;
    const kind = region[i + 1] > 127 ? 'pole' : region[i] > 127 ? 'seam' : 'rest';
    const difference = Math.max(...[0, 1, 2].map((k) => Math.abs(a[i + k] - b[i + k])));
    result[kind][0] += 1;
    result[kind][1] += difference;
    result[kind][2] += difference > 64 ? 1 : 0;
  }
  return result;
}

async function save(name) {
  const blob = await new Promise((resolve) => canvas.toBlob(resolve));
  await fetch(`/${name}.png`, { method: 'POST', body: blob });
}

async function run() {
  const job = await (await fetch('/job')).json();
  const pictures = {}, report = { models: {}, comparisons: [] };
  for (const model of job.models) {
    const object = await load(model);
    report.models[model.name] = statistics(object);
    prepare(object, model);
    pictures[model.name] = [];
    for (const [i, side] of sides.entries()) {
      pictures[model.name].push(picture(object, side, job.size));
      if (model.save) await save(`${model.name}_${i}`);
    }
  }
  for (const comparison of job.comparisons ?? []) {
    const [a, b] = [pictures[comparison.a], pictures[comparison.b]];
    if (comparison.region) {
      const sums = sides.map((_, i) => differences(a[i], b[i], pictures[comparison.region][i]));
      const total = {};
      for (const kind of ['seam', 'pole', 'rest']) {
        const [count, difference, wrong] =
          sums.reduce((sum, one) => sum.map((x, k) => x + one[kind][k]), [0, 0, 0]);
        total[kind] = { pixels: count, mean: difference / count, wrong: wrong / count };
      }
      report.comparisons.push({ ...comparison, ...total });
    } else {
      const views = sides.map((_, i) => psnr(a[i], b[i]));
      const decibels = ({ squares, samples }) => 10 * Math.log10(255 ** 2 / (squares / samples));
      const all = views.reduce((sum, v) => ({ squares: sum.squares + v.squares,
                                              samples: sum.samples + v.samples }));
      report.comparisons.push({ ...comparison, psnr: decibels(all), views: views.map(decibels) });
    }
  }
  return report;
}

let report;
try {
  report = await run();
} catch (error) {
  report = { error: String(error?.stack ?? error) };
}
await fetch('/done', { method: 'POST', body: JSON.stringify(report) });

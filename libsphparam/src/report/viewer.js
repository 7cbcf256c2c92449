(() => {
'use strict';
const views = [...document.querySelectorAll('model-viewer')];
const controls = document.querySelector('.controls');
const morph = document.getElementById('morph');
const play = document.getElementById('play');
const message = document.getElementById('viewer-message');
const rest = Number(morph.dataset.rest), change = Number(morph.dataset.change);  // seconds
let playing = false;

function show() {
  for (const view of views) {
    if (view.loaded) view.currentTime = rest + change * morph.value / 100;
  }
  const percent = Math.round(morph.value);
  morph.setAttribute('aria-valuetext',
      percent === 0 ? morph.dataset.from : percent === 100 ? morph.dataset.to : percent + ' % of the way');
}

function paint() {
  const chosen = controls.querySelector('input[name=surface]:checked');
  for (const view of views) {
    if (chosen && view.loaded) view.variantName = chosen.value;
  }
}

function setPlaying(on) {
  playing = on;
  play.textContent = on ? 'Pause' : 'Play';
  if (!on) return;
  const from = Math.acos(1 - 2 * morph.value / 100), begun = performance.now();
  const step = now => {
    if (!playing) return;
    morph.value = 50 * (1 - Math.cos(from + Math.PI * (now - begun) / 1000 / change));
    show();
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

// A picture of the user's own, 2:1 with the north pole above, in place of the base colour that is seen.
async function showPicture(file) {
  if (!file) return;
  const url = URL.createObjectURL(file);
  try {
    for (const view of views) {
      const texture = await view.createTexture(url);
      for (const material of view.model.materials) {
        if (material.isActive) material.pbrMetallicRoughness.baseColorTexture.setTexture(texture);
      }
    }
    message.textContent = file.name + ' is shown.';
  } catch (error) {
    message.textContent = file.name + ' cannot be shown: a PNG, JPEG or WebP image is needed.';
  } finally {
    URL.revokeObjectURL(url);
  }
}

const own = document.getElementById('own');
if (own) {
  own.addEventListener('change', () => showPicture(own.files[0]));
  for (const view of views) {
    view.addEventListener('dragover', event => event.preventDefault());
    view.addEventListener('drop', event => {
      event.preventDefault();
      showPicture(event.dataTransfer.files[0]);
    });
  }
}
if (matchMedia('(prefers-reduced-motion: reduce)').matches) {
  for (const view of views) view.autoRotate = false;
}

for (const view of views) {
  view.addEventListener('load', () => {
    view.animationName = view.availableAnimations[0];
    view.updateComplete.then(() => { show(); paint(); });
    controls.hidden = false;
  });
  view.addEventListener('error', event => {
    message.textContent = 'The 3D view cannot be shown here (' + event.detail.type +
        '): this is a picture of it.';
  });
  view.addEventListener('camera-change', event => {
    if (event.detail.source !== 'user-interaction') return;
    for (const other of views) {
      if (other === view) continue;
      const orbit = view.getCameraOrbit();
      other.cameraOrbit = orbit.theta + 'rad ' + orbit.phi + 'rad ' + orbit.radius + 'm';
      other.jumpCameraToGoal();
    }
  });
  view.src = document.getElementById(view.dataset.model).textContent;
}
morph.addEventListener('input', () => { setPlaying(false); show(); });
play.addEventListener('click', () => setPlaying(!playing));
controls.addEventListener('change', event => { if (event.target.name === 'surface') paint(); });
controls.addEventListener('submit', event => event.preventDefault());
})();

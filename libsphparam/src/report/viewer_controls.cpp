#include "report/viewer_controls.h"

// The models' bytes stand in the page as text that no browser runs; the script hands them to the
// viewer, keeps all viewers at the same time of their animation and looking from the same side, and
// tells screen readers where the slider is.

namespace sphparam {

std::string_view viewer_style() {
  return R"css(.views{display:grid;gap:1rem;margin:1rem 0 .5rem}
.view{border:1px solid #d1d9e0;border-radius:10px;overflow:hidden;
background:radial-gradient(circle at 50% 40%,#fbfcfd,#dfe5ec)}
.view figcaption{padding:.3rem .8rem;background:#fff;border-top:1px solid #d1d9e0}
.view model-viewer,.view .still{display:block;width:100%;height:min(34rem,68vh,105vw);
background:transparent;--progress-bar-color:transparent;--poster-color:transparent}
.views.many .view model-viewer,.views.many .view .still{height:min(24rem,54vh,100vw)}
.view img{width:100%;height:100%;object-fit:contain;background:transparent;border-radius:0}
.controls{display:flex;flex-wrap:wrap;gap:.6rem 1.5rem;align-items:center;margin:.5rem 0 1rem}
.controls[hidden]{display:none}
.morph{display:flex;flex:1 1 19rem;gap:.6rem;align-items:center}
.morph input{flex:1;min-width:6rem;height:2rem;accent-color:#1f5fd0}
.controls button{font:inherit;min-width:5.2rem;min-height:2.4rem;padding:.2rem .8rem;
border:1px solid #818b98;border-radius:8px;color:inherit;background:transparent;cursor:pointer}
.surfaces{display:flex;flex-wrap:wrap;gap:.4rem;margin:0;padding:0;border:0}
.surfaces legend{float:left;padding:0;margin-right:.5rem;line-height:2.4rem}
.surfaces label{position:relative;display:block}
.surfaces input{position:absolute;inset:0;width:100%;height:100%;margin:0;opacity:0;cursor:pointer}
.surfaces span{display:block;padding:.35rem .8rem;border:1px solid #818b98;border-radius:8px}
.surfaces input:checked+span{color:#fff;background:#1f5fd0;border-color:#1f5fd0}
.surfaces input:focus-visible+span{outline:3px solid #1f5fd0;outline-offset:2px}
.hint{font-size:.85rem;color:#59636e}
@media(prefers-color-scheme:dark){
.view{border-color:#3d444d;background:radial-gradient(circle at 50% 40%,#2b323c,#12171e)}
.view figcaption{background:#0d1117;border-color:#3d444d}
.morph input{accent-color:#6cb0ff}
.surfaces input:checked+span{color:#0d1117;background:#6cb0ff;border-color:#6cb0ff}
.surfaces input:focus-visible+span{outline-color:#6cb0ff}
.hint{color:#9198a1}
}
@media print{.controls,.hint{display:none}}
)css";
}

std::string_view viewer_controls() {
  return R"js((() => {
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
      percent === 0 ? 'mesh' : percent === 100 ? 'sphere' : percent + ' % of the way');
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
controls.addEventListener('change', paint);
controls.addEventListener('submit', event => event.preventDefault());
})();
)js";
}

}  // namespace sphparam

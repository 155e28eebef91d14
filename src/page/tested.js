// What the open step's search tested: faces, coloured and hatched by their verdicts.
'use strict';

// Of each FaceVerdict.
const VERDICT_COLOURS = ['#7f7f7f', '#1f5fa8', '#6b4fa0', '#c98a00', '#c0392b', '#2e8b57', '#202020'].map(hex);
// The open step, if it is one that searches.
function searchingStep() {
    const step = page.walk && page.walk.steps[page.step - 1];
    return step && ['nearest', 'light'].includes(step.kind) ? step : null;
}

// counts: Map of a verdict's number -> how many; mark(number): the element that shows its colour.
function showKey(id, counts, mark, word) {
    const items = [...counts].sort((a, b) => a[0] - b[0]);
    $(id).replaceChildren(...items.map(([k, count]) => element('span', {}, mark(k), `${word(k)} ${count}`)));
}

const ink = colour => `--ink: rgb(${colour.map(c => 255 * c)})`;

function showTested() {
    if (!view) return;
    const step = $('tested').checked && searchingStep();
    const list = step ? page.tracer.tested(...page.pixel, step.hit, step.light) : [];
    const faces = [];
    const counts = new Map();
    for (let k = 0; k < list.length; k += 2) {
        faces.push({face: list[k], colour: VERDICT_COLOURS[list[k + 1]], hatch: list[k + 1]});
        counts.set(list[k + 1], (counts.get(list[k + 1]) || 0) + 1);
    }
    view.showVerdicts(faces);
    const mark = k => element('i', {class: 'hatch hatch-' + k, style: ink(VERDICT_COLOURS[k])});
    showKey('tested-key', counts, mark, k => page.tracer.verdict(k));
    if (($('tested').checked || page.tree !== 'none') && !searchingStep())
        $('tested-key').textContent = "Open a step that looks for a face, or for what is in a light's way.";
}

$('tested').addEventListener('change', showTested);
for (const event of ['pixel', 'step']) on(event, showTested);

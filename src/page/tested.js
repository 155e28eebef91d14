// What the open step's search tested: faces, coloured and hatched by their verdicts, and the nodes of a tree, as boxes.
'use strict';

const NODE_NUMBERS = 9; // of page.h
const TREES = {kdtree: 2, bvh: 3}; // AccelKind
// Of each FaceVerdict.
const VERDICT_COLOURS = ['#7f7f7f', '#1f5fa8', '#6b4fa0', '#c98a00', '#c0392b', '#2e8b57', '#202020'].map(hex);
// Of each NodeVerdict: entered, missed, beyond, unneeded.
const NODE_STYLES = [
    {colour: hex('#00838f'), width: 2.5},
    {colour: hex('#8a8d93'), width: 1, dash: 4},
    {colour: hex('#8a5a2b'), width: 1, dash: 10},
    {colour: hex('#8a8d93'), width: 1, dash: 20},
];
const BOX_EDGES = [0, 1, 2, 3, 4, 5, 6, 7].flatMap(a =>
    [1, 2, 4].filter(bit => !(a & bit)).map(bit => [a, a | bit]),
);

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
    if (($('tested').checked || TREES[$('tree').value]) && !searchingStep())
        $('tested-key').textContent = "Open a step that looks for a face, or for what is in a light's way.";
}

// The edges of the boxes that the search met, and their key.
function nodeLines() {
    const kind = TREES[$('tree').value];
    const step = kind && searchingStep();
    const list = step ? page.tracer.nodes(...page.pixel, kind, step.hit, step.light) : [];
    const lines = [];
    const counts = new Map();
    for (let at = 0; at < list.length; at += NODE_NUMBERS) {
        const verdict = list[at];
        const corner = k => [0, 1, 2].map(axis => list[at + (k & (1 << axis) ? 6 : 3) + axis]);
        const width = NODE_STYLES[verdict].width * Math.max(0.4, 1 - 0.1 * list[at + 2]); // thinner, level by level
        for (const [a, b] of BOX_EDGES)
            lines.push({from: corner(a), to: corner(b), ...NODE_STYLES[verdict], width});
        counts.set(verdict, (counts.get(verdict) || 0) + 1);
    }
    const mark = k =>
        element('i', {class: NODE_STYLES[k].dash ? 'dashed' : false, style: ink(NODE_STYLES[k].colour)});
    showKey('nodes-key', counts, mark, k => 'nodes ' + page.tracer.nodeVerdict(k));
    return lines;
}

$('tested').addEventListener('change', showTested);
$('tree').addEventListener('change', () => {
    showRays();
    showTested();
});
for (const event of ['pixel', 'step']) on(event, showTested);

// The nodes of the tree that the open step's search met, as boxes: all of them, or one after the other as the ray meets
// them, each with what the program says of it.
'use strict';

const NODE_NUMBERS = 9; // of page.h
const TREES = {none: 1, kdtree: 2, bvh: 3, lbvh: 4}; // AccelKind
const ENTERED = 0;
// Of each NodeVerdict: entered, missed, beyond, unneeded.
const NODE_STYLES = [
    {colour: hex('#00838f'), width: 3},
    {colour: hex('#c0392b'), width: 2, dash: 4},
    {colour: hex('#8a5a2b'), width: 2, dash: 10},
    {colour: hex('#6b4fa0'), width: 2, dash: 20},
];
const BOX_EDGES = [0, 1, 2, 3, 4, 5, 6, 7].flatMap(a =>
    [1, 2, 4].filter(bit => !(a & bit)).map(bit => [a, a | bit]),
);

let node = 0; // the one that is shown, from 1; 0: all
const nodesOf = {search: '', list: []}; // the search that was asked for last

// [{verdict, leaf, level, corner(0..7), words}], in the order in which the search meets them.
function readNodes(step) {
    const {numbers, words} = page.tracer.nodes(...page.pixel, step.hit, step.light);
    return Array.from({length: numbers.length / NODE_NUMBERS}, (_, k) => {
        const [verdict, leaf, level, ...box] = numbers.subarray(NODE_NUMBERS * k, NODE_NUMBERS * (k + 1));
        const corner = c => [0, 1, 2].map(axis => box[(c & (1 << axis) ? 3 : 0) + axis]);
        return {verdict, leaf, level, corner, words: words[k]};
    });
}

// Another search begins with all of its nodes.
function nodesOfStep() {
    const step = page.tree !== 'none' && searchingStep();
    const search = step ? [page.path, page.pixel, page.columns, page.grid, page.step, page.tree].join() : '';
    if (search !== nodesOf.search) {
        node = 0;
        Object.assign(nodesOf, {search, list: step ? readNodes(step) : []});
    }
    return nodesOf.list;
}

// The nodes that the search is inside of when it comes to nodes[last].
function pathTo(nodes, last) {
    const path = new Set();
    let level = nodes[last].level;
    for (let k = last - 1; k >= 0; k--)
        if (nodes[k].verdict === ENTERED && nodes[k].level < level) {
            path.add(nodes[k]);
            level = nodes[k].level;
        }
    return path;
}

// How wide the box is drawn, 0: not at all. Of all nodes, the leaves that were entered stand out. Of one, it alone
// does, and the nodes around it are thin.
function widthOf(one, nodes, path) {
    const {width} = NODE_STYLES[one.verdict];
    if (node) return one === nodes[node - 1] ? width : path.has(one) ? 1 : 0;
    return one.verdict === ENTERED && one.leaf ? 2 : 0.8;
}

// The edges of the boxes; tells their key and what the program says of the one that is shown.
function nodeLines() {
    const nodes = nodesOfStep();
    showNodeTools(nodes);
    const path = node ? pathTo(nodes, node - 1) : null;
    return nodes.flatMap(one => {
        const width = widthOf(one, nodes, path);
        const style = {...NODE_STYLES[one.verdict], width};
        if (!width) return [];
        return BOX_EDGES.map(([a, b]) => ({from: one.corner(a), to: one.corner(b), ...style}));
    });
}

function showNodeTools(nodes) {
    const counts = new Map();
    for (const {verdict} of nodes) counts.set(verdict, (counts.get(verdict) || 0) + 1);
    const mark = k =>
        element('i', {class: NODE_STYLES[k].dash ? 'dashed' : false, style: ink(NODE_STYLES[k].colour)});
    showKey('nodes-key', counts, mark, k => 'nodes ' + page.tracer.nodeVerdict(k));
    $('node-tools').hidden = !nodes.length;
    $('node-number').textContent = node ? `${node} of ${nodes.length} nodes` : `all ${nodes.length} nodes`;
    $('node-words').textContent = node ? nodes[node - 1].words : '';
}

// Past the last one, and before the first one, all are shown.
function stepNode(by) {
    const count = nodesOfStep().length;
    node = count ? (node + by + count + 1) % (count + 1) : 0;
    showRays();
}

function setTree(name) {
    page.tree = TREES[name] ? name : 'none';
    $('tree').value = page.tree;
    if (!page.pixel) return;
    setTracer();
    choosePixel(...page.pixel);
}

$('tree').addEventListener('change', () => setTree($('tree').value));
$('node-forward').addEventListener('click', () => stepNode(1));
$('node-back').addEventListener('click', () => stepNode(-1));
on('scene', () => {
    nodesOf.search = ''; // an edit leaves its name
});

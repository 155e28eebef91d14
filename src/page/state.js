// What the page is about: the scene, its picture, the chosen pixel and its walkthrough; and who wants to know when it
// changes.
'use strict';

const $ = id => document.getElementById(id);

const page = {
    files: new Map(), // normal path -> Uint8Array: scenes, models and libraries
    names: new Map(), // normal path -> the path as the user gave it, which the program's texts say
    shipped: new Map(), // the files as the page came with them
    module: null, // the compiled tracer
    tracer: null, // the page's own; workers have theirs
    path: '', // of the scene
    columns: 0,
    rows: 0,
    grid: 1, // n x n rays per pixel; 0: as the scene says
    arithmetic: 0, // PageArithmetic of page.h
    tree: 'none', // in which the walkthrough searches: a name of TREES
    map: 'picture',
    pixel: null, // [column, row]
    pinned: null, // the other pixel of a comparison: {pixel, walk}
    walk: null, // what the tracer says of the pixel: {pixel, hits, end, head, steps, ...}
    textbook: null, // what textbook arithmetic finds there: {summary, steps, parts}; null: it is not asked
    lines: null, // its rays in space
    step: 0, // the number of the step that is shown; 0: all
    verbose: false,
};

// Events: 'scene' (another one), 'render' (it starts), 'picture' (pixels came), 'pixel' (one was chosen), 'step',
// 'pin'.
const listeners = new Map();

function on(event, act) {
    listeners.set(event, [...(listeners.get(event) || []), act]);
}
function announce(event) {
    for (const act of listeners.get(event) || []) act();
}

// element('p', {class: 'note'}, 'text', another, ...)
function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes))
        if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
        else if (value !== false) made.setAttribute(key, value === true ? '' : value);
    made.append(...children.filter(child => child !== null && child !== undefined));
    return made;
}

// The escape sequences with which the program colours its text, as elements: bold, signs + and -, a pixel's colour.
function inked(text) {
    const out = document.createDocumentFragment();
    let style = {};
    for (const piece of text.split(/(\x1b\[[\d;]*m)/)) {
        const code = /^\x1b\[([\d;]*)m$/.exec(piece);
        if (!code) {
            if (piece) out.append(style.name ? element(style.name, style.attributes, piece) : piece);
            continue;
        }
        const colour = /^48;2;(\d+);(\d+);(\d+)$/.exec(code[1]);
        style =
            code[1] === '1'
                ? {name: 'b'}
                : code[1] === '32'
                  ? {name: 'i', attributes: {class: 'plus'}}
                  : code[1] === '31'
                    ? {name: 'i', attributes: {class: 'minus'}}
                    : colour
                      ? {name: 'i', attributes: {style: `background: rgb(${colour.slice(1).join()})`}}
                      : {};
    }
    return out;
}

// Of the page's letters, in pixels: larger on large screens.
const letterSize = () => parseFloat(getComputedStyle(document.documentElement).fontSize);

const plain = text => text.replace(/\x1b\[[\d;]*m/g, '');

function fail(message) {
    $('error').textContent = message;
    $('error').hidden = !message;
    if (message) document.body.dataset.state = 'failed';
}

// The page's own tracer works with what is chosen; 'render' tells the workers.
function setTracer() {
    const {columns, rows, grid, arithmetic} = page;
    page.tracer.set({columns, rows, grid, arithmetic, tree: TREES[page.tree]});
}

function choosePixel(column, row) {
    const clamp = (x, n) => Math.max(0, Math.min(n - 1, x));
    page.pixel = [clamp(column, page.columns), clamp(row, page.rows)];
    page.walk = readWalk(page.pixel);
    page.textbook = readTextbook(page.pixel);
    page.lines = page.tracer.lines(...page.pixel);
    page.step = Math.min(page.step, page.walk.steps.length);
    announce('pixel');
}

// Its lines are as wide as their column is, unless told otherwise.
function readWalk([column, row], columns = columnsOfText()) {
    const style = {colour: true, verbose: page.verbose, columns};
    return JSON.parse(page.tracer.trace(column, row, 'steps', style));
}

function readTextbook([column, row]) {
    if (!page.arithmetic) return null;
    return JSON.parse(page.tracer.trace(column, row, 'textbook-steps', {colour: true, columns: columnsOfText()}));
}

function goToStep(step) {
    if (!page.walk) return;
    page.step = Math.max(0, Math.min(page.walk.steps.length, step));
    announce('step');
}

// The hand-out: two sheets of paper that are laid out before printing. On the first one the picture, the view and the
// answer; then the steps, in the largest letters in which all that are open fit. Where none is open, or they are too
// many, those are printed that tell most; the last line says which are left out.
'use strict';

const SHEETS = 2;
const LETTERS = {largest: 8.2, smallest: 7, step: 0.2}; // of the steps, in points
const FOOT = 24; // room for the line of what is left out
const COLUMNS_PRINTED = 100;
// What tells most: the sum, then the first hit's steps, then what the others add, then their lights.
const WORTH = {sum: 0, primary: 1, nearest: 2, adds: 3, light: 4, mirror: 5};
const worthOf = step => WORTH[step.kind] + 6 * (step.hit - 1) * (step.kind !== 'sum');

// A copy, which is there at once: an image would have to be decoded first.
function copyOf(canvas) {
    const copy = element('canvas', {width: canvas.width, height: canvas.height});
    copy.getContext('2d').drawImage(canvas, 0, 0);
    return copy;
}

function twinOf(id) {
    const twin = $(id).cloneNode(true);
    twin.removeAttribute('id');
    twin.classList.add('twin-of-' + id);
    return twin;
}

function printedView() {
    if (!view) return twinOf('plans');
    const background = view.background;
    view.background = [1, 1, 1];
    view.draw();
    const frame = element('div', {class: 'space-frame'}, copyOf(view.canvas), twinOf('labels'));
    frame.style.setProperty('--shape', view.canvas.width / view.canvas.height);
    view.background = background;
    view.draw();
    return frame;
}

function traceCommands() {
    const words = [`rectray trace ${page.path}`, `--pixel ${page.pixel}`, `--size ${page.columns}x${page.rows}`];
    if (page.grid) words.push(`--grid ${page.grid}`);
    const exact = [...words, ...(page.tree === 'none' ? [] : [`--accel ${page.tree}`])].join(' ');
    if (!page.arithmetic) return [exact];
    const precision = ARITHMETICS[page.arithmetic] === 'float' ? 'float' : 'double';
    return [exact, [...words, '--arithmetic textbook', `--precision ${precision}`].join(' ')];
}

function firstPart() {
    const stage = element('div', {class: 'stage'}, copyOf($('picture')), twinOf('cross'));
    const answer = twinOf('answer');
    for (const link of answer.querySelectorAll('.link')) link.remove();
    return [
        element('div', {class: 'sheet-pictures'}, stage, printedView()),
        ...traceCommands().map(command => element('p', {}, element('code', {}, command))),
        element('h2', {}, ...$('answer-title').cloneNode(true).childNodes),
        answer,
    ];
}

// In textbook arithmetic its text says what is exactly so, too.
const linesOf = step => bodyOf(textbookStep(step) || step).split('\n');

// Lines [from, to) of a step.
function printedStep(step, from = 0, to = Infinity) {
    const words = textbookStep(step) ? ` (${ARITHMETIC_WORDS[page.arithmetic]})` : '';
    return element(
        'section',
        {class: 'sheet-step'},
        element(
            'h3',
            {},
            element('b', {}, `Step ${step.number}.`),
            ` ${step.title}${words}${from ? ', continued' : ''}`,
        ),
        element('pre', {}, inked(linesOf(step).slice(from, to).join('\n'))),
    );
}

// "2, 5 to 9, 12"
function listOf(numbers) {
    const runs = [];
    for (const n of numbers)
        if (runs.length && runs[runs.length - 1][1] === n - 1) runs[runs.length - 1][1] = n;
        else runs.push([n, n]);
    return runs.map(([a, b]) => (a === b ? a : b === a + 1 ? `${a}, ${b}` : `${a} to ${b}`)).join(', ');
}

// Drops hits from the end of the answer until it fits, and says how many.
function shorten(sheet) {
    const hits = [...sheet.querySelectorAll('.hit')];
    const isTooLong = () => sheet.scrollHeight > sheet.clientHeight;
    if (isTooLong()) sheet.classList.add('dense');
    const note = element('li', {class: 'hit'});
    for (let kept = hits.length - 1; isTooLong() && kept > 0; kept--) {
        hits[kept].remove();
        note.textContent = `${hits.length - kept} more are left out.`;
        hits[0].parentElement.append(note);
    }
}

// How high a step's heading and each of its lines are, and after which lines it may be cut.
function measure(step, part) {
    const body = part.lastElementChild;
    const lines = linesOf(step);
    const cuts = lines.map((line, k) => (line ? 0 : k)).filter(Boolean);
    const head = part.offsetHeight - body.offsetHeight;
    return {step, head, line: body.offsetHeight / lines.length, count: lines.length, cuts};
}

// The pieces of the steps, one below the other: [{step, sheet, from, to}]. null where they do not fit.
function placeSteps(sizes, rooms) {
    const pieces = [];
    let sheet = 0;
    let left = rooms[0];
    for (const {step, head, line, count, cuts} of sizes) {
        let from = 0;
        while (from < count) {
            const fits = k => head + (k - from) * line + 2 <= left;
            const to = fits(count) ? count : Math.max(from, ...cuts.filter(k => k > from + 3 && fits(k)));
            if (to > from) pieces.push({step, sheet, from, to});
            left -= to > from ? head + (to - from) * line + 2 : 0;
            from = to;
            if (from === count) break;
            if (++sheet >= rooms.length) return null;
            left = rooms[sheet];
        }
    }
    return pieces;
}

// The pieces of all that are wanted, or of as many as fit, the most telling first.
function choosePieces(wanted, sizeOf, rooms) {
    const placed = steps => placeSteps(steps.map(sizeOf), rooms);
    let chosen = wanted;
    let pieces = placed(wanted);
    if (pieces) return {chosen, pieces};
    chosen = [];
    for (const step of [...wanted].sort((a, b) => worthOf(a) - worthOf(b))) {
        const more = [...chosen, step].sort((a, b) => a.number - b.number);
        const found = placed(more);
        if (found) [chosen, pieces] = [more, found];
    }
    return {chosen, pieces: pieces || []};
}

function layOutSteps(sheets, steps) {
    const folds = [...$('steps').children];
    const open = steps.filter((step, k) => folds[k].open);
    const wanted = open.length ? open : steps;
    const holders = sheets.map(() => element('div', {class: 'sheet-steps'}));
    sheets.forEach((sheet, k) => sheet.append(holders[k]));
    const parts = steps.map(step => printedStep(step));
    holders[0].append(...parts);
    const full = sheets[1].clientHeight;
    const rooms = [full - holders[0].offsetTop - 4, full - FOOT];
    let choice = null;
    for (let size = LETTERS.largest; !choice || size >= LETTERS.smallest; size -= LETTERS.step) {
        $('handout').style.setProperty('--letters', size + 'pt');
        const sizes = new Map(steps.map((step, k) => [step, measure(step, parts[k])]));
        choice = choosePieces(wanted, step => sizes.get(step), rooms);
        if (choice.chosen === wanted) break;
    }
    for (const part of parts) part.remove();
    for (const {step, sheet, from, to} of choice.pieces) holders[sheet].append(printedStep(step, from, to));
    const left = steps.filter(step => !choice.chosen.includes(step)).map(step => step.number);
    const note = `Left out: ${left.length > 1 ? 'steps' : 'step'} ${listOf(left)}. `;
    if (left.length) sheets[1].append(element('p', {class: 'note'}, note, 'The first sheet says which command tells all.'));
}

function layOut() {
    if (!page.walk) return;
    const root = document.documentElement;
    const sheets = Array.from({length: SHEETS}, () => element('div', {class: 'sheet'}));
    $('handout').replaceChildren(...sheets);
    root.classList.add('measuring');
    sheets[0].append(...firstPart());
    shorten(sheets[0]);
    layOutSteps(sheets, readWalk(page.pixel, COLUMNS_PRINTED).steps);
    root.classList.remove('measuring');
}

addEventListener('beforeprint', layOut);
addEventListener('afterprint', () => $('handout').replaceChildren());

// The hand-out of two pages: the picture, the view and the answer; then the steps. Where none is open, those are opened
// for the time of printing that tell most and fit on a page: the first hit's, what the others add, the sum.
'use strict';

// In points: a page, what picture and answer take of the first one, and what each hit; the headings of open and of
// closed steps; a line of text for each point of its size.
const PRINT = {page: 735, picture: 330, hit: 52, open: 11, closed: 5, line: 1.2, smallest: 5.8, largest: 8};

const linesToPrint = step => bodyOf(step).split('\n').length + 1;
const heightOf = (step, size) => PRINT.open - PRINT.closed + linesToPrint(step) * size * PRINT.line;
const headHeight = size =>
    $('head-fold').open ? (headText(page.walk).split('\n').length + 1) * size * PRINT.line : PRINT.open;
const restOfFirstPage = () => Math.max(0, PRINT.page - PRINT.picture - PRINT.hit * page.walk.hits.length);
const printRoom = size =>
    PRINT.page + 0.95 * restOfFirstPage() - headHeight(size) - PRINT.closed * page.walk.steps.length;

function stepsToPrint() {
    const worth = step =>
        ({sum: 0, primary: 1, nearest: 2, adds: 3, light: 4, mirror: 5})[step.kind] +
        6 * (step.hit - 1) * (step.kind !== 'sum');
    const chosen = new Set();
    let room = printRoom(PRINT.smallest);
    for (const step of [...page.walk.steps].sort((a, b) => worth(a) - worth(b))) {
        const height = heightOf(step, PRINT.smallest);
        if (height > room) continue;
        chosen.add(step.number);
        room -= height;
    }
    return chosen;
}

function beforePrint() {
    if (!page.walk) return;
    const folds = [...$('steps').children];
    const none = !folds.some(fold => fold.open);
    const chosen = none ? stepsToPrint() : new Set();
    for (const fold of folds.filter(fold => chosen.has(Number(fold.dataset.number)))) {
        fold.open = true;
        fold.classList.add('opened-to-print');
    }
    const opened = page.walk.steps.filter((step, k) => folds[k].open);
    let size = PRINT.largest;
    const isTooLarge = () => opened.reduce((sum, step) => sum + heightOf(step, size), 0) > printRoom(size);
    while (size > PRINT.smallest && isTooLarge()) size -= 0.1;
    document.body.style.setProperty('--print-size', size + 'pt');
}

function afterPrint() {
    for (const fold of document.querySelectorAll('.opened-to-print')) {
        fold.open = false;
        fold.classList.remove('opened-to-print');
    }
}

addEventListener('beforeprint', beforePrint);
addEventListener('afterprint', afterPrint);

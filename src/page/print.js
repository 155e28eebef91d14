// The hand-out of two pages: the picture, the view and the answer; then the steps. Where none is open, those are opened
// for the time of printing that tell most and fit on a page: the first hit's, what the others add, the sum.
'use strict';

// In points: what a page has beside its heading, what the headings of open and closed steps take, a line of text for
// each point of its size.
const PRINT = {page: 690, open: 11, closed: 5, line: 1.2, smallest: 5.8, largest: 8};

const linesToPrint = step => bodyOf(step).split('\n').length + 1;
const heightOf = (step, size) => PRINT.open - PRINT.closed + linesToPrint(step) * size * PRINT.line;
const printRoom = () => PRINT.page - PRINT.closed * page.walk.steps.length;

function stepsToPrint() {
    const worth = step =>
        ({sum: 0, primary: 1, nearest: 2, adds: 3, light: 4, mirror: 5})[step.kind] +
        6 * (step.hit - 1) * (step.kind !== 'sum');
    const chosen = new Set();
    let room = printRoom();
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
    while (size > PRINT.smallest && opened.reduce((sum, step) => sum + heightOf(step, size), 0) > printRoom())
        size -= 0.1;
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

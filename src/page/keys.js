// The keyboard: arrows move the cross-hair, space plays the steps. A key that a field or a button uses is left to it.
'use strict';

const isBusy = target => target.closest('input, textarea, select, dialog, #space') !== null;
const usesSpace = target => target.closest('button, summary, a, [type=checkbox]') !== null;

function movePixel(dx, dy) {
    if (page.pixel) choosePixel(page.pixel[0] + dx, page.pixel[1] + dy);
}

const KEYS = {
    ArrowLeft: by => movePixel(-by, 0),
    ArrowRight: by => movePixel(by, 0),
    ArrowUp: by => movePixel(0, -by),
    ArrowDown: by => movePixel(0, by),
    p: togglePin,
    l: lookAlongRay,
    n: by => stepNode(by > 1 ? -1 : 1),
    v: showValues,
    '?': () => $('help').showModal(),
    Escape: () => {
        if (page.pinned) togglePin();
        else goToStep(0);
    },
};

document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || isBusy(event.target)) return;
    if (event.key === ' ') {
        if (usesSpace(event.target)) return;
        event.preventDefault();
        play(event.shiftKey ? -1 : 1);
        return;
    }
    const act = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act(event.shiftKey ? 10 : 1);
});

$('help-button').addEventListener('click', () => $('help').showModal());
for (const dialog of document.querySelectorAll('dialog')) {
    dialog.querySelector('.close').addEventListener('click', () => dialog.close());
    dialog.addEventListener('click', event => {
        if (event.target === dialog) dialog.close();
    });
}

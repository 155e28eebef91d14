// Two arithmetics: exact, which the walkthrough tells, and the textbook's formulas as they stand, in double or in
// float. Without what guards against rounding, acne and cracks appear in the picture; at a pixel the answer says where
// the two part, and each step what the textbook finds there.
'use strict';

const ARITHMETICS = ['exact', 'textbook', 'float']; // PageArithmetic of page.h
const ARITHMETIC_WORDS = ['exact', 'textbook in double', 'textbook in float'];

function setArithmetic(word) {
    page.arithmetic = Math.max(0, ARITHMETICS.indexOf(word));
    $('arithmetic').value = ARITHMETICS[page.arithmetic];
    $('grid').lastElementChild.disabled = page.arithmetic > 0; // adaptive sampling is not in the text
    if (page.arithmetic && !page.grid) {
        page.grid = 1;
        $('grid').value = '1';
    }
    if (page.path) openScene(page.path, {keep: true, pixel: page.pixel, step: page.step});
}

function bytesIn(arithmetic) {
    const packed = page.tracer.bytes(...page.pixel, arithmetic);
    return [packed >> 16, (packed >> 8) & 255, packed & 255];
}

function arithmeticRow(word, arithmetic) {
    const bytes = bytesIn(arithmetic);
    const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true', style: `background: rgb(${bytes})`});
    const differs = String(bytes) !== String(bytesIn(0));
    const note = arithmetic === 0 ? '' : differs ? 'differs' : 'the same';
    return element(
        'tr',
        {class: differs && 'words'},
        element('td', {}, word),
        element('td', {}, swatch, element('code', {}, bytes.join(' '))),
        element('td', {class: 'note'}, note),
    );
}

// What the textbook finds at a step of the exact walkthrough; undefined where it says nothing.
function textbookStep(step) {
    const steps = page.textbook ? page.textbook.steps : [];
    return steps.find(found => (step.kind === 'sum' ? found.kind === 'sum' : keyOf(found) === keyOf(step)));
}

// Steps that only the textbook's path has: it goes on where the exact one ends.
function textbookOnly() {
    const beside = page.walk.steps.map(textbookStep);
    return (page.textbook ? page.textbook.steps : []).filter(found => !beside.includes(found));
}

const partsAt = step =>
    Boolean(page.textbook) &&
    step.kind !== 'sum' &&
    page.textbook.parts.some(part => part.hit === step.hit && part.light === step.light && textbookStep(step));

// Its summary, without the pixel's name, which stands above.
function showArithmetics() {
    if (!page.textbook) return;
    const first = page.walk.steps.find(partsAt);
    $('answer').prepend(
        element(
            'section',
            {class: 'textbook', 'aria-label': 'Textbook arithmetic'},
            element('pre', {tabindex: '0'}, plain(page.textbook.summary).replace(/^.*\n/, '').trimEnd()),
            first
                ? element(
                      'button',
                      {type: 'button', class: 'link', onclick: () => play(first.number - page.step)},
                      `Step ${first.number}. ${first.title}`,
                  )
                : '',
            element('table', {class: 'arithmetics'}, ...ARITHMETIC_WORDS.map(arithmeticRow)),
        ),
    );
}

$('arithmetic').addEventListener('change', () => setArithmetic($('arithmetic').value));
on('pixel', showArithmetics);

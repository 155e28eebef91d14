// Two arithmetics: exact, which the walkthrough tells, and the textbook's formulas as they stand, in double or in
// float. Without what guards against rounding, acne and cracks appear in the picture; at a pixel the bytes say what
// differs.
'use strict';

const ARITHMETICS = ['exact', 'textbook', 'float']; // PageArithmetic of page.h
const ARITHMETIC_WORDS = ['exact', 'textbook in double', 'textbook in float'];

function setArithmetic(word) {
    page.arithmetic = Math.max(0, ARITHMETICS.indexOf(word));
    $('arithmetic').value = ARITHMETICS[page.arithmetic];
    if (page.arithmetic && !page.grid) {
        page.grid = 1; // adaptive sampling is not in the text
        $('grid').value = '1';
    }
    if (page.path) openScene(page.path, {keep: true, pixel: page.pixel, step: page.step});
}

function bytesIn(arithmetic) {
    const packed = page.tracer.bytes(...page.pixel, arithmetic);
    return [packed >> 16, (packed >> 8) & 255, packed & 255];
}

function showArithmetics() {
    if (!page.arithmetic) return;
    const exact = bytesIn(0);
    const rows = ARITHMETIC_WORDS.map((word, arithmetic) => {
        const bytes = bytesIn(arithmetic);
        const swatch = element('span', {
            class: 'swatch',
            'aria-hidden': 'true',
            style: `background: rgb(${bytes})`,
        });
        const note = arithmetic === 0 ? '' : String(bytes) === String(exact) ? 'the same' : 'differs';
        return element(
            'tr',
            {class: note === 'differs' && 'words'},
            element('td', {}, word),
            element('td', {}, swatch, element('code', {}, bytes.join(' '))),
            element('td', {class: 'note'}, note),
        );
    });
    $('answer').append(element('table', {class: 'arithmetics'}, ...rows));
}

$('arithmetic').addEventListener('change', () => setArithmetic($('arithmetic').value));
on('pixel', showArithmetics);

// The walkthrough's steps, folded. One that is opened becomes the step that the view in space shows.
'use strict';

// A step's text without its heading, which the fold has.
const bodyOf = step => step.text.replace(/^\n.*\n\n?/, '').replace(/\n+$/, '');

function stepSource(step) {
    const functions = step.functions.map(f => element('code', {title: 'src/' + f.file}, f.name));
    const sections = step.sections.map(number =>
        element(
            'button',
            {type: 'button', class: 'link', onclick: () => showSection(number)},
            sectionTitle(number),
        ),
    );
    return element(
        'p',
        {class: 'source'},
        'In C: ',
        ...functions.flatMap((f, k) => (k ? [', ', f] : [f])),
        element('br'),
        'The algorithm: ',
        ...sections.flatMap((s, k) => (k ? [', ', s] : [s])),
    );
}

const textOf = step => element('pre', {tabindex: '0'}, inked(bodyOf(step)));

// In textbook arithmetic its numbers come first, with what is exactly so; the exact step can be opened beside it.
function stepText(step) {
    const found = textbookStep(step);
    if (!found) return textOf(step);
    return element(
        'div',
        {class: 'textbook'},
        element('b', {}, ARITHMETIC_WORDS[page.arithmetic]),
        textOf(found),
        element('details', {class: 'exact'}, element('summary', {}, ARITHMETIC_WORDS[0]), textOf(step)),
    );
}

function textbookFold(step) {
    const summary = element(
        'summary',
        {},
        element('b', {}, `Step ${step.number}.`),
        ' ' + step.title,
        element('span', {class: 'tag'}, `only ${ARITHMETIC_WORDS[page.arithmetic]}`),
    );
    return element('details', {class: 'step'}, summary, textOf(step));
}

function stepFold(step) {
    const fold = element(
        'details',
        {class: 'step', 'data-number': step.number},
        element(
            'summary',
            {},
            element('b', {}, `Step ${step.number}.`),
            ' ' + step.title,
            partsAt(step) ? element('span', {class: 'tag'}, 'textbook differs') : '',
        ),
        stepText(step),
        stepSource(step),
    );
    fold.firstChild.addEventListener('click', () => {
        // the fold changes after this
        if (!fold.open) goToStep(step.number);
        else if (page.step === step.number) goToStep(0);
    });
    return fold;
}

// 80 to 100, as the program's lines may be: as many as fit in letters that are a little smaller than the page's.
const LETTER_SHARE = 0.9;
function columnsOfText() {
    const letter = 0.605 * LETTER_SHARE * letterSize();
    const columns = Math.max(80, Math.min(100, Math.floor($('answer').clientWidth / letter)));
    document.body.style.setProperty('--columns', columns);
    return columns;
}

// The heading of the steps is the page's own.
const headText = walk => walk.head.replace(/\n.*Step by step.*\n+/, '').trimEnd();

function showSteps() {
    $('head').replaceChildren(inked(headText(page.walk)));
    const opened = new Set(
        [...$('steps').querySelectorAll('details[open]')].map(fold => Number(fold.dataset.number)),
    );
    $('steps').replaceChildren(...page.walk.steps.map(stepFold));
    $('textbook-only').replaceChildren(...textbookOnly().map(textbookFold));
    for (const fold of $('steps').children) fold.open = opened.has(Number(fold.dataset.number));
    showStep();
}

function showStep() {
    const count = page.walk ? page.walk.steps.length : 0;
    $('step-number').textContent = page.step ? `step ${page.step} of ${count}` : `${count} steps`;
    for (const fold of $('steps').children) {
        const now = Number(fold.dataset.number) === page.step;
        fold.classList.toggle('now', now);
        if (now) fold.toggleAttribute('aria-current', true);
        else fold.removeAttribute('aria-current');
    }
}

// Space and its like: opens the next step alone and brings it into view.
function play(by) {
    goToStep(page.step + by);
    for (const fold of $('steps').children) {
        fold.open = Number(fold.dataset.number) === page.step;
        if (fold.open) fold.scrollIntoView({block: 'nearest', behavior: 'instant'});
    }
}

$('forward').addEventListener('click', () => play(1));
$('back').addEventListener('click', () => play(-1));
$('open-all').addEventListener('click', () => {
    const all = [...$('steps').children];
    const open = !all.every(fold => fold.open);
    for (const fold of all) fold.open = open;
});
$('verbose').addEventListener('change', () => {
    page.verbose = $('verbose').checked;
    if (page.pixel) choosePixel(...page.pixel);
});
let columns = 0;
new ResizeObserver(() => {
    if (page.pixel && columns && columnsOfText() !== columns) choosePixel(...page.pixel);
    columns = columnsOfText();
}).observe($('answer'));
on('pixel', showSteps);
on('step', showStep);

// One screen that answers: the path, what each hit adds, which lights reach it, why the path ended, the three bytes.
'use strict';

const VERDICT_SIGNS = {reaches: '✓', blocked: '✕', 'behind face': '–'};
const byte = x => Math.floor(255 * Math.max(0, Math.min(1, x)) + 0.5);
const rgb = colour => `rgb(${colour.map(byte).join()})`;

function lightChip(light) {
    const by = light.blocker ? ` by ${light.blocker}` : '';
    return element(
        'li',
        {class: 'light ' + light.verdict.replace(' ', '-')},
        element('span', {'aria-hidden': 'true'}, VERDICT_SIGNS[light.verdict] + ' '),
        `light ${light.light} ${light.verdict}${by}`,
    );
}

// Many lights are told in the program's own sentence.
function lightsOf(hit) {
    if (hit.lights.length > 8) return element('p', {class: 'lights'}, hit.lights_words);
    return element('ul', {class: 'lights', 'aria-label': hit.lights_words}, ...hit.lights.map(lightChip));
}

// A bar as long as the brightest of the three numbers, in their colour.
function contributionBar(contribution) {
    const bar = element('span', {class: 'bar', 'aria-hidden': 'true'}, element('span'));
    bar.firstChild.style.width = Math.max(0.5, 100 * Math.min(1, Math.max(...contribution))) + '%';
    bar.firstChild.style.background = rgb(contribution);
    return bar;
}

function hitItem(hit) {
    return element(
        'li',
        {class: 'hit', 'data-hit': hit.name},
        element(
            'div',
            {class: 'hit-name'},
            element('b', {}, hit.name),
            element('strong', {}, hit.face),
            element('span', {class: 'note'}, `material ${hit.material}`),
        ),
        element(
            'div',
            {class: 'share'},
            element('span', {class: 'weight'}, `weight ${hit.weight}`),
            contributionBar(hit.contribution),
            element('code', {}, hit.words),
        ),
        lightsOf(hit),
    );
}

function backgroundItem(background) {
    return element(
        'li',
        {class: 'hit'},
        element('div', {class: 'hit-name'}, element('strong', {}, 'background')),
        element(
            'div',
            {class: 'share'},
            element('span', {class: 'weight'}, `weight ${background.weight}`),
            contributionBar(background.contribution),
            element('code', {}, background.words),
        ),
    );
}

function byteBars(rgb) {
    return element(
        'ul',
        {class: 'bytes'},
        ...['red', 'green', 'blue'].map((name, k) => {
            const bar = element('span', {class: 'bar ' + name, 'aria-hidden': 'true'}, element('span'));
            bar.firstChild.style.width = rgb[k] / 2.55 + '%';
            return element('li', {}, element('span', {}, name), bar, element('code', {}, String(rgb[k])));
        }),
    );
}

function pathWords(walk) {
    return walk.path.flatMap((name, k) => (k ? [element('span', {class: 'arrow'}, ' → '), name] : [name]));
}

function showAnswer() {
    const walk = page.walk;
    const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
    swatch.style.background = `rgb(${walk.rgb.join()})`;
    $('answer-title').replaceChildren(swatch, walk.pixel);
    $('answer').replaceChildren(
        element('p', {class: 'path'}, ...pathWords(walk)),
        element(
            'ol',
            {class: 'hits'},
            ...walk.hits.map(hitItem),
            walk.background ? backgroundItem(walk.background) : null,
        ),
        element('p', {class: 'end'}, walk.end),
        byteBars(walk.rgb),
    );
    if (walk.samples > 1)
        $('answer').append(
            element('p', {class: 'note'}, `The path is that of sample (0, 0) of ${walk.samples}.`),
        );
}

on('pixel', showAnswer);

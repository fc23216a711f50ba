// Puts the bundled script and style into page.html: the one file that camber writes its data into.
import {readFileSync, writeFileSync} from 'node:fs';

const read = (path) => readFileSync(new URL(path, import.meta.url), 'utf8');
const built = 'node_modules/.camber-page/';
const three = JSON.parse(read('node_modules/three/package.json'));

// Nothing in the script may look like the end of its element.
const script = read(`${built}page.js`).replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const notice = `<!--
The page of camber report. Camber is under the Apache License 2.0.
It contains three.js ${three.version}, under this licence:

${read('node_modules/three/LICENSE').trim()}
-->`;

const page = read('page.html')
  .replace('<!--notice-->', () => notice)
  .replace('/*style*/', () => read(`${built}page.css`).trim())
  .replace('/*script*/', () => script.trim());
writeFileSync(new URL('../src/camber/page/bundle/page.html', import.meta.url), page);
console.log(`page.html: ${(page.length / 1024).toFixed(0)} kB, three.js ${three.version}`);

import {defineConfig} from 'vite';

// One script and one style sheet; assemble.js puts both into page.html.
export default defineConfig({
  build: {
    target: 'es2022',
    lib: {entry: 'src/main.js', formats: ['iife'], name: 'camber', fileName: () => 'page.js',
      cssFileName: 'page'},
    outDir: 'node_modules/.camber-page',
    chunkSizeWarningLimit: 2000,
  },
});

#!/usr/bin/env bash
# Builds src/camber/page/bundle/page.html, the page of `camber report`, from web/. Needs npm and, the
# first time, the network; the result is committed, so that building Camber needs neither.
set -e
cd "$(dirname "$0")/../web"
[ -d node_modules ] || npm ci --no-audit --no-fund
npm run build --silent

#!/bin/sh
# Makes three.bundle.js and three.LICENSE of this folder's parent from the npm registry.
# The versions decide the bytes: npm's own checksums hold the packages to them.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here/three.js" "$here/package.json" "$here/package-lock.json" "$work"
cd "$work"
npm ci --no-audit --no-fund
node_modules/.bin/esbuild three.js --bundle --minify --format=iife --global-name=THREE \
    --target=es2020 --charset=ascii --legal-comments=none --outfile="$here/../three.bundle.js"
cp node_modules/three/LICENSE "$here/../three.LICENSE"

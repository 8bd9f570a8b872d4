"""The page in which a linkage moves: one file of HTML that needs no network.

Read in this order, bottom-up: `link_shapes` (what links and joints look like), `motion_page` (the
file), `report_page` (a file of all that was found, in which that one stands), `mechanism_report`
(all that is found of a mechanism, and that file of it). What they are made of is data of the
package: ``page.html``, ``report.html``, ``viewer.js`` and ``viewer.css`` are its own,
``self_test.js`` plays with it where its address ends in ``#test``, and ``three.bundle.js`` is what
``source/build.sh`` makes of three.js, whose licence is ``three.LICENSE``.
"""

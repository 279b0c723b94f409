/* SPDX-License-Identifier: Apache-2.0 */
    .section .rodata

    .global trueaxis_published_js_begin, trueaxis_published_js_end
trueaxis_published_js_begin:
    .incbin "studies/published/published.js"
trueaxis_published_js_end:

/* SPDX-License-Identifier: Apache-2.0 */
/* The files of the report inside the binary; the paths are found through the include path src. */
    .section .rodata

    .global trueaxis_report_html_begin, trueaxis_report_html_end
trueaxis_report_html_begin:
    .incbin "report/report.html"
trueaxis_report_html_end:

    .global trueaxis_report_css_begin, trueaxis_report_css_end
trueaxis_report_css_begin:
    .incbin "report/report.css"
trueaxis_report_css_end:

    .global trueaxis_echarts_begin, trueaxis_echarts_end
trueaxis_echarts_begin:
    .incbin TRUEAXIS_ECHARTS
trueaxis_echarts_end:

    .global trueaxis_report_js_begin, trueaxis_report_js_end
trueaxis_report_js_begin:
    .incbin "report/format.js"
    .incbin "report/page.js"
    .incbin "report/charts.js"
    .incbin "report/reading_charts.js"
    .incbin "report/form_charts.js"
    .incbin "report/part_form.js"
    .incbin "report/seats_charts.js"
    .incbin "report/reference.js"
    .incbin "report/findings.js"
    .incbin "report/diagnosis_charts.js"
    .incbin "report/diagnosis.js"
    .incbin "report/target.js"
    .incbin "report/correction.js"
    .incbin "report/glossary.js"
    .incbin "report/report.js"
trueaxis_report_js_end:

    .global trueaxis_machine_js_begin, trueaxis_machine_js_end
trueaxis_machine_js_begin:
    .incbin "report/format.js"
    .incbin "report/page.js"
    .incbin "report/charts.js"
    .incbin "report/machine_charts.js"
    .incbin "report/findings.js"
    .incbin "report/machine_diagnosis.js"
    .incbin "report/machine_report.js"
trueaxis_machine_js_end:

    .global trueaxis_sweep_js_begin, trueaxis_sweep_js_end
trueaxis_sweep_js_begin:
    .incbin "report/format.js"
    .incbin "report/page.js"
    .incbin "report/charts.js"
    .incbin "report/sweep_charts.js"
    .incbin "report/sweep.js"
trueaxis_sweep_js_end:
